/**
 * The members of a scene as svt/illustrate/scene/scene_members.cpp declares them, by JSON pointer with * for any index.
 * scripts/update_options.py generates this file; manual changes are lost.
 */

export const kSceneMembers = {
  "/format": { type: "text", choices: ["svt-scene"], help: "identifies a scene" },
  "/version": { type: "whole", minimum: 1, maximum: 1, help: "version of the format" },
  "/size": { type: "whole", unit: "pixels", minimum: 1, maximum: 16384, default: [1280, 720], help: "width and height" },
  "/samples": { type: "whole", minimum: 1, maximum: 16, choices: [1, 4, 9, 16], default: 4, option: "--samples", group: "View", help: "rays per pixel" },
  "/surfaces": { type: "text", choices: ["voxels", "exact"], option: "--surfaces", group: "Style", help: "the source of the labels: the voxels, or the faces of the model, which are exact at any spacing, but take up to a few times as long" },
  "/look": { type: "text", choices: ["plain", "paper", "blueprint", "dark"], default: "plain", option: "--look", group: "Style", help: "colours, lines and hatches of the whole picture: plain, paper (for print), blueprint or dark (for slides)" },
  "/title": { type: "text", option: "--title", group: "Illustrate", help: "write a title into the picture" },
  "/scaleBar": { type: "flag", default: false, option: "--scale-bar", group: "Illustrate", help: "draw a scale bar; parallel projection only, because no other picture has a single scale" },
  "/northArrow": { type: "flag", default: false, option: "--north-arrow", group: "Illustrate", help: "draw an arrow to true north" },
  "/colorBy": { type: "text", option: "--color-by", group: "Illustrate", help: "colour visible components by class, name, storey, volume, area of rooms, owner, voxels or an attribute, with a legend" },
  "/field": { type: "object", help: "a field of the volume as colours of surfaces" },
  "/field/name": { type: "text", option: "--field", group: "Illustrate", help: "colour cut faces and visible surfaces by this field of the volume, with a legend" },
  "/field/time": { type: "number", unit: "seconds", minimum: -1000000000000, maximum: 1000000000000, option: "--time", group: "Illustrate", help: "time of the field" },
  "/field/range": { type: "number", minimum: -1000000000000, maximum: 1000000000000, option: "--range", group: "Illustrate", help: "values of the field at the ends of the colour map" },
  "/field/isolines": { type: "number", minimum: 0, maximum: 1000000000000, default: 0, option: "--isolines", group: "Illustrate", help: "draw lines of equal value of the field, this step apart, in its unit; 0: none" },
  "/field/map": { type: "text", choices: ["viridis", "cividis", "inferno", "batlow", "vik", "greys"], default: "viridis", option: "--map", group: "Illustrate", help: "colour map of the field; vik is for values on both sides of a middle" },
  "/field/per": { type: "text", choices: ["mean", "max", "min"], option: "--per", group: "Illustrate", help: "colour each component by this figure of the field over its voxels, not by place" },
  "/legend": { type: "flag", default: true, help: "draw a legend for the colours of colorBy or of a field" },
  "/explode": { type: "number", unit: "metres", minimum: 0, maximum: 1000, default: 0, option: "--explode", group: "Illustrate", help: "draw the storeys apart, with this vertical gap between them" },
  "/sun": { type: "object", help: "light by the sun, with shadows" },
  "/sun/time": { type: "text", option: "--sun", group: "Illustrate", help: "date and hour of the sun, such as '2026-06-21 15:00'; with Z or +02:00 unless it is the time of the meridian" },
  "/sun/place": { type: "number", unit: "degrees", minimum: -180, maximum: 180, option: "--place", group: "Illustrate", help: "latitude and longitude of the building" },
  "/sun/size": { type: "number", unit: "degrees", minimum: 0, maximum: 20, default: 0.53, help: "diameter of the sun: larger is softer" },
  "/insets": { type: "list", minimum: 0, maximum: 4, help: "small pictures in the corners of the picture" },
  "/insets/*/corner": { type: "text", choices: ["top-right", "bottom-right", "top-left", "bottom-left"], default: "top-right", help: "corner of the picture that contains the inset" },
  "/insets/*/size": { type: "number", minimum: 0.05, maximum: 0.5, default: 0.3, help: "share of the picture's width and height" },
  "/insets/*/title": { type: "text", help: "write a title into the inset" },
  "/insets/*/mark": { type: "flag", default: true, help: "frame the part of the picture that the inset shows, with lines to it" },
  "/insets/*/scene": { type: "object", help: "its camera, and members of the scene that differ in it" },
  "/camera": { type: "object", help: "position and view direction of the picture" },
  "/camera/preset": { type: "text", choices: ["iso", "iso-se", "iso-sw", "iso-ne", "iso-nw", "front", "back", "left", "right", "top", "bottom"], default: "iso", option: "--camera", group: "View", help: "named view from which the picture is taken" },
  "/camera/around": { type: "text", option: "--around", group: "View", help: "fit the view to the selection of the query" },
  "/camera/fit": { type: "text", choices: ["visible", "all"], default: "visible", option: "--fit", group: "View", help: "fit a named view to the visible parts, or always to the whole volume; all, if eye or target is given, or for a series of pictures" },
  "/camera/parallel": { type: "flag", default: false, option: "--ortho", group: "View", help: "parallel projection" },
  "/camera/fieldOfView": { type: "number", unit: "degrees", minimum: 0.001, maximum: 179.999, default: 30, option: "--fov", group: "View", help: "vertical field of view" },
  "/camera/zoom": { type: "number", minimum: 0.01, maximum: 100, default: 1, option: "--zoom", group: "View", help: "nearer (above 1) or farther than the preset" },
  "/camera/eye": { type: "number", unit: "metres", minimum: -1000000000, maximum: 1000000000, option: "--eye", group: "View", help: "position of the viewer, from the lower corner of the grid, in world axes" },
  "/camera/target": { type: "number", unit: "metres", minimum: -1000000000, maximum: 1000000000, option: "--target", group: "View", help: "point in the centre of the picture, from the lower corner of the grid, in world axes" },
  "/background": { type: "text", option: "--background", group: "Style", help: "#rrggbb, #rgb or a colour name" },
  "/transparent": { type: "flag", default: false, option: "--transparent", group: "Style", help: "leave the background transparent" },
  "/lines": { type: "object", help: "lines between objects, and at jumps of the depth" },
  "/lines/strength": { type: "number", minimum: 0, maximum: 1, option: "--edges", group: "Style", help: "strength of lines between objects" },
  "/lines/width": { type: "number", unit: "pixels", minimum: 0, maximum: 16, option: "--line-width", group: "Style", help: "width of lines between objects" },
  "/lines/cutWidth": { type: "number", unit: "pixels", minimum: 0, maximum: 16, option: "--cut-width", group: "Style", help: "width of lines around cut faces" },
  "/lines/color": { type: "text", help: "#rrggbb, #rgb or a colour name" },
  "/hatches": { type: "object", help: "hatches of cut faces" },
  "/hatches/show": { type: "flag", option: "--hatch", group: "Style", help: "hatch cut faces, by material or class" },
  "/hatches/spacing": { type: "number", unit: "metres", minimum: 0.0001, maximum: 10000, option: "--hatch-spacing", group: "Style", help: "distance of hatch lines" },
  "/ambientOcclusion": { type: "number", minimum: 0, maximum: 1, default: 0.6, help: "strength of the darkening in corners" },
  "/names": { type: "text", repeats: true, option: "--names", group: "Illustrate", help: "name the visible labels that the query selects: inside them if the text fits, otherwise at the sides of the picture, with leader lines" },
  "/passes": { type: "list", minimum: 1, maximum: 64, help: "passes, drawn one after the other" },
  "/passes/*/show": { type: "text", repeats: true, option: "--show", group: "Style", help: "show only the selection of the query" },
  "/passes/*/hide": { type: "text", repeats: true, option: "--hide", group: "Style", help: "hide the selection of the query" },
  "/passes/*/styles": { type: "list", help: "styles of labels; later ones override earlier ones" },
  "/passes/*/styles/*/select": { type: "text", help: "labels that get the style" },
  "/passes/*/styles/*/ghost": { type: "flag", default: false, help: "draw solid labels as coloured air, and hide air" },
  "/passes/*/styles/*/color": { type: "text", help: "#rrggbb, #rgb or a colour name" },
  "/passes/*/styles/*/opacity": { type: "number", minimum: 0, maximum: 1, help: "share of light stopped by 1 m; 1: solid, 0: hidden" },
  "/passes/*/styles/*/hatch": { type: "text", choices: ["none", "masonry", "concrete", "reinforced-concrete", "timber", "insulation", "earth", "steel", "glass", "general"], help: "hatch of cut faces" },
  "/passes/*/cut": { type: "text", help: "cut away a region, such as 'z>1.2 and not box(2,2,0,4,4,3)'" },
  "/passes/*/keep": { type: "text", option: "--keep", group: "Cut", help: "draw nothing outside of a region, such as storey(Attic)" },
  "/passes/*/join": { type: "text", choices: ["over", "replace", "depth"], default: "over", help: "over: in front of earlier passes; replace: removes earlier passes wherever it draws; depth: the nearer pass is in front" },
  "/passes/*/shell": { type: "text", choices: ["component", "room", "unit", "storey", "building"], option: "--shell", group: "Illustrate", help: "draw only the hulls of components, rooms, units, storeys or the building" },
  "/passes/*/level": { type: "whole", minimum: 0, maximum: 6, help: "level of detail, 0 is the finest" },
  "/passes/*/lines": { type: "list", help: "feature edges of the model's meshes, at their depth inside the volume" },
  "/passes/*/lines/*/select": { type: "text", help: "labels whose edges are drawn, visible or not" },
  "/passes/*/lines/*/width": { type: "number", unit: "pixels", minimum: 0.1, maximum: 64, default: 1, help: "width of the lines" },
  "/passes/*/lines/*/color": { type: "text", help: "#rrggbb, #rgb or a colour name" },
  "/passes/*/lines/*/hidden": { type: "text", choices: ["faint", "dashed", "none"], default: "faint", help: "lines behind opaque objects" },
  "/passes/*/meshes": { type: "text", repeats: true, option: "--vectors", group: "Lines", help: "draw the selection of the query as meshes, not as voxels; size<M: all objects shorter than M metres along each axis" },
  "/passes/*/cells": { type: "flag", default: false, help: "draw each voxel as a box with edges" },
  "/motion": { type: "object", help: "changes of the scene with time, for films" },
  "/motion/seconds": { type: "number", unit: "seconds", minimum: 0.01, maximum: 3600, default: 6, option: "--seconds", group: "Motion", help: "duration of the motion" },
  "/motion/rate": { type: "whole", minimum: 1, maximum: 120, default: 25, option: "--rate", group: "Motion", help: "pictures per second of a film" },
  "/motion/turn": { type: "number", unit: "degrees", minimum: -36000, maximum: 36000, default: 0, option: "--turn", group: "Motion", help: "angle by which the camera orbits the model, counter-clockwise from above, evenly; 360: once around" },
  "/motion/pace": { type: "text", choices: ["smooth", "even"], default: "smooth", help: "change of values from key to key: smooth at both ends, or even" },
  "/motion/keys": { type: "list", help: "the scene at some times; numbers, points, colours and the numbers of regions are interpolated between them" },
  "/motion/keys/*/at": { type: "number", unit: "seconds", minimum: 0, maximum: 3600, help: "the time, after that of the previous key" },
  "/motion/keys/*/scene": { type: "object", help: "values of members of the scene at this time" },
} as const;

/** A `*.scene.json`: docs/formats/scene.schema.json. The page edits it, the library draws it. */
export interface Scene { format?: "svt-scene";
  version?: number;
  size?: [number, number];
  samples?: 1 | 4 | 9 | 16;
  surfaces?: "voxels" | "exact";
  look?: "plain" | "paper" | "blueprint" | "dark";
  title?: string;
  scaleBar?: boolean;
  northArrow?: boolean;
  colorBy?: string;
  field?: { name: string;
  time?: number;
  range?: [number, number];
  isolines?: number;
  map?: "viridis" | "cividis" | "inferno" | "batlow" | "vik" | "greys";
  per?: "mean" | "max" | "min";
  };
  legend?: boolean;
  explode?: number;
  sun?: { time: string;
  place?: [number, number];
  size?: number;
  };
  insets?: { corner?: "top-right" | "bottom-right" | "top-left" | "bottom-left";
  size?: number;
  title?: string;
  mark?: boolean;
  scene?: Scene;
  }[];
  camera?: { preset?: "iso" | "iso-se" | "iso-sw" | "iso-ne" | "iso-nw" | "front" | "back" | "left" | "right" | "top" | "bottom";
  around?: string;
  fit?: "visible" | "all";
  parallel?: boolean;
  fieldOfView?: number;
  zoom?: number;
  eye?: [number, number, number];
  target?: [number, number, number];
  };
  background?: string;
  transparent?: boolean;
  lines?: { strength?: number;
  width?: number;
  cutWidth?: number;
  color?: string;
  };
  hatches?: { show?: boolean;
  spacing?: number;
  };
  ambientOcclusion?: number;
  names?: string[];
  passes?: { show?: string[];
  hide?: string[];
  styles?: { select: string;
  ghost?: boolean;
  color?: string;
  opacity?: number;
  hatch?: "none" | "masonry" | "concrete" | "reinforced-concrete" | "timber" | "insulation" | "earth" | "steel" | "glass" | "general";
  }[];
  cut?: string;
  keep?: string;
  join?: "over" | "replace" | "depth";
  shell?: "component" | "room" | "unit" | "storey" | "building";
  level?: number;
  lines?: { select?: string;
  width?: number;
  color?: string;
  hidden?: "faint" | "dashed" | "none";
  }[];
  meshes?: string[];
  cells?: boolean;
  }[];
  motion?: { seconds?: number;
  rate?: number;
  turn?: number;
  pace?: "smooth" | "even";
  keys?: { at: number;
  scene: Scene;
  }[];
  };
  }

export type SceneMember = keyof typeof kSceneMembers;

/** The members of a declaration. */
export interface DeclaredMember {
  readonly type: "flag" | "whole" | "number" | "text" | "object" | "list";
  readonly unit?: string;
  readonly minimum?: number;
  readonly maximum?: number;
  readonly choices?: readonly (string | number)[];
  readonly default?: string | number | boolean | readonly number[];
  /** Takes an array of such values. */
  readonly repeats?: true;
  /** The option of `svt render` for this member; `group` is its heading in help. */
  readonly option?: string;
  readonly group?: string;
  readonly help: string;
}

/** The members that declare something: SceneMemberWith<"minimum" | "maximum"> are those with a range. */
export type SceneMemberWith<Key extends string> = {
  [Name in SceneMember]: (typeof kSceneMembers)[Name] extends Record<Key, unknown> ? Name : never;
}[SceneMember];

/** The values of a member that has choices. */
export type ChoiceOf<Name extends SceneMemberWith<"choices">> = (typeof kSceneMembers)[Name]["choices"][number];

export type Unit = (typeof kSceneMembers)[SceneMemberWith<"unit">]["unit"];
