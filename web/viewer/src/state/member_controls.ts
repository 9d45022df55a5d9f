/**
 * Ranges, choices and first values of controls that represent a member of a scene. They are those of the declaration.
 * All intended differences are listed here, with their reasons.
 */

import {
  kSceneMembers,
  type ChoiceOf,
  type DeclaredMember,
  type Scene,
  type SceneMember,
  type SceneMemberWith,
} from "../generated/scene_members";

export interface MemberRange {
  member: SceneMemberWith<"minimum" | "maximum">;
  /** Only for the control; a scene may have any value of the range. */
  step: number;
  /** Narrower than declared. */
  minimum?: number;
  maximum?: number;
}

export const kRanges = {
  opacity: { member: "/passes/*/styles/*/opacity", step: 0.01 },
  // Below, the picture is almost parallel, and the page has a separate parallel projection. Above, objects at the borders
  // of the picture are distorted.
  fieldOfView: { member: "/camera/fieldOfView", step: 1, minimum: 10, maximum: 100 },
  pictureSide: { member: "/size", step: 1 },
  // The member has both numbers, of which the first is up to 90 degrees.
  latitude: { member: "/sun/place", step: 0.0001, minimum: -90, maximum: 90 },
  longitude: { member: "/sun/place", step: 0.0001 },
  // Their numbers are of any size, by the unit of the field; the controls take any step.
  fieldLines: { member: "/field/isolines", step: 1 },
  fieldEnd: { member: "/field/range", step: 1 },
} as const satisfies Record<string, MemberRange>;

/** The values that a control offers. */
export function rangeOfControl(control: keyof typeof kRanges): { minimum: number; maximum: number; step: number } {
  const { member, step, minimum, maximum }: MemberRange = kRanges[control];
  const declared = kSceneMembers[member];
  return { minimum: minimum ?? declared.minimum, maximum: maximum ?? declared.maximum, step };
}

/** Whether a scene may have the value. */
export function isAllowed(member: SceneMemberWith<"minimum" | "maximum">, value: number): boolean {
  const { minimum, maximum } = kSceneMembers[member];
  return value >= minimum && value <= maximum;
}

/** The reasons why plain members of the picture do not have a control made from their declaration. */
const kWithoutPlainControl: Partial<Record<SceneMember, string>> = {
  "/colorBy": "offers the attributes of the model",
  "/explode": "features are picked where they stand",
};

type TopLevel<Name> = Name extends `/${infer Key}` ? (Key extends `${string}/${string}` ? never : Key) : never;
/** The names of members at the top of a scene. */
export type PlainMember = TopLevel<SceneMember> & keyof Scene;

/** The members of the picture whose controls are made from their declarations, in the order of these. */
export const kPlainMembers = (Object.keys(kSceneMembers) as SceneMember[]).filter((name) => {
  const member: DeclaredMember = kSceneMembers[name];
  const isPlain = (member.type === "flag" || member.type === "text" || member.type === "number") && !member.repeats;
  return isPlain && member.group === "Illustrate" && name.lastIndexOf("/") === 0 && !(name in kWithoutPlainControl);
});

/** Whether a plain member may have the value. */
export function isValueOf(name: SceneMember, value: unknown): boolean {
  const { type, choices, minimum = -Infinity, maximum = Infinity }: DeclaredMember = kSceneMembers[name];
  if (choices) return (choices as readonly unknown[]).includes(value);
  if (type === "flag") return typeof value === "boolean";
  if (type === "text") return typeof value === "string";
  return typeof value === "number" && value >= minimum && value <= maximum;
}

/** Named views on buttons, in the order of the keys 1 to 7. A turn with the mouse gives the other slanted ones. */
export const kViews = ["iso", "front", "right", "back", "left", "top", "bottom"] as const satisfies readonly ChoiceOf<"/camera/preset">[];

/** First values of the page that differ from the defaults of a scene. */
export const kOtherFirstValues = {
  // Saved pictures are for documents and slides, so they are as large as screens.
  pictureSize: { member: "/size", value: [1920, 1080] },
  // A walking person is inside rooms, where the declared angle shows only a part of one wall.
  walkingFieldOfView: { member: "/camera/fieldOfView", value: 65 },
} as const satisfies Record<string, { member: SceneMember; value: unknown }>;
