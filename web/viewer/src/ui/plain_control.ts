/** A control for a member of a scene, made from its declaration: a check box, a choice, a number or a text. */

import { html } from "lit";
import { kSceneMembers, type DeclaredMember, type SceneMember } from "../generated/scene_members";
import { help, memberLabel } from "../texts";

/** @param value  undefined: the default */
export function plainControl(name: SceneMember, value: unknown, change: (value: unknown) => void) {
  const { type, choices, minimum, maximum, default: byDefault }: DeclaredMember = kSceneMembers[name];
  const now = value ?? byDefault ?? "";
  const label = memberLabel(name);
  const id = name.slice(1).replace(/[A-Z]/g, (letter) => `-${letter.toLowerCase()}`);
  if (type === "flag")
    return html`<label class="check" title=${help(name)}><input type="checkbox" id=${id} .checked=${now === true} @change=${(e: Event) => change((e.target as HTMLInputElement).checked)} />${label}</label>`;
  const titled = (control: unknown) => html`<h3 id="${id}-title">${label}</h3>${control}`;
  if (choices)
    return titled(
      html`<select id=${id} aria-labelledby="${id}-title" title=${help(name)} @change=${(e: Event) => change((e.target as HTMLSelectElement).value)}>${choices.map((choice) => html`<option value=${choice} ?selected=${choice === now}>${choice}</option>`)}</select>`,
    );
  if (type === "number")
    return titled(
      html`<input id=${id} aria-labelledby="${id}-title" title=${help(name)} type="number" min=${minimum ?? ""} max=${maximum ?? ""} step="any" .value=${String(now)} @change=${(
        e: Event,
      ) => {
        const input = e.target as HTMLInputElement;
        if (input.checkValidity() && input.value !== "") change(Number(input.value));
      }} />`,
    );
  return titled(
    html`<input id=${id} aria-labelledby="${id}-title" title=${help(name)} .value=${String(now)} @change=${(e: Event) => change((e.target as HTMLInputElement).value.trim())} />`,
  );
}
