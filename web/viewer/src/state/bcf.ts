/**
 * Bookmarks as BCF 3.0 (buildingSMART, BCF-XML release 3.0), for issue lists of other programs: one topic per bookmark, with
 * comment, author, status, camera, clipping planes, visibility, selection, colours and a picture. Positions are in the model's
 * own coordinates.
 */

import type { Engine, Point, VolumeInfo } from "../engine";
import { basisOf, type Box } from "../camera/camera";
import { add, dot, normalized, scale, sub } from "../camera/vec";
import { kSceneMembers } from "../generated/scene_members";
import { normalOf } from "../tools/plane_outline";
import { unzipped, zipOf } from "../ui/files";
import { dataUrl, kSmallPicture, kStatuses, type Bookmark } from "./bookmarks";
import type { FeatureIndex } from "./feature_index";
import { isAllowed } from "./member_controls";
import { ofClass, ofId } from "./queries";
import { initialState, type Camera, type Section, type ViewState } from "./view_state";

/** The model that a view refers to. */
export interface BcfModel {
  engine: Engine;
  info: VolumeInfo;
  index: FeatureIndex;
  box: Box;
  /** Width by height of the picture. */
  aspect: number;
  file: string;
}

const kIfcId = /^[0-9A-Za-z_$]{22}$/;

// eslint-disable-next-line no-control-regex -- XML forbids these characters
const escaped = (text: string) => text.replace(/[&<>"]/g, (c) => `&#${c.charCodeAt(0)};`).replace(/[\x00-\x08\x0b\x0c\x0e-\x1f]/g, " ");
const element = (name: string, content: string) => `<${name}>${content}</${name}>`;
const xyz = (name: string, p: Point) =>
  element(name, (["X", "Y", "Z"] as const).map((axis, i) => element(axis, String(Number(p[i]!.toFixed(9))))).join(""));
const document = (root: string) => `<?xml version="1.0" encoding="UTF-8"?>\n${root}\n`;

/** A GUID of the content, so that the same view always has the same GUID: four FNV-1a sums of 32 bits, as UUID version 8. */
function guidOf(text: string): string {
  const bytes = new TextEncoder().encode(text);
  const hex = [0, 1, 2, 3]
    .map((seed) => {
      let sum = 0x811c9dc5 ^ Math.imul(seed, 0x9e3779b1);
      for (const byte of bytes) sum = Math.imul(sum ^ byte, 0x01000193);
      return (sum >>> 0).toString(16).padStart(8, "0");
    })
    .join("");
  return [hex.slice(0, 8), hex.slice(8, 12), `8${hex.slice(13, 16)}`, `8${hex.slice(17, 20)}`, hex.slice(20)].join("-");
}

/** The picture of a topic as PNG; null: it cannot be drawn. */
export type Snapshot = (state: ViewState) => Promise<Uint8Array | null>;

/**
 * @param author  of topics whose bookmark names none
 * @param date  of creation of all topics
 */
export async function bcfOf(views: Bookmark[], model: BcfModel, author: string, date: Date, snapshot: Snapshot): Promise<ArrayBuffer> {
  const listed = (name: string, entry: string, values: readonly string[]) =>
    element(name, [...new Set(values)].map((value) => element(entry, escaped(value))).join(""));
  const statuses = [...kStatuses, ...views.flatMap(({ status }) => status ?? [])];
  const users = [author, ...views.flatMap((view) => view.author ?? [])];
  const files: { name: string; text: string | Uint8Array }[] = [
    { name: "bcf.version", text: document('<Version VersionId="3.0"/>') },
    {
      name: "extensions.xml",
      text: document(
        `<Extensions><TopicTypes><TopicType>View</TopicType></TopicTypes>${listed("TopicStatuses", "TopicStatus", statuses)}${listed("Users", "User", users)}</Extensions>`,
      ),
    },
  ];
  for (const [n, view] of views.entries()) {
    const guid = guidOf(`${n} ${view.name} ${JSON.stringify(view.state)}`),
      viewGuid = guidOf(`view ${guid}`);
    const picture = await snapshot(view.state);
    files.push({ name: `${guid}/`, text: "" });
    files.push({
      name: `${guid}/markup.bcf`,
      text: document(markup(view, model, view.author ?? author, date, guid, viewGuid, picture !== null)),
    });
    files.push({ name: `${guid}/viewpoint.bcfv`, text: document(await viewpoint(view.state, model, viewGuid)) });
    if (picture) files.push({ name: `${guid}/snapshot.png`, text: picture });
  }
  return zipOf(files);
}

function markup(view: Bookmark, model: BcfModel, author: string, date: Date, guid: string, viewGuid: string, hasPicture: boolean): string {
  const { name, comment, status = kStatuses[0] } = view;
  const made = element("Date", date.toISOString()) + element("Author", escaped(author));
  const comments = comment
    ? `<Comments><Comment Guid="${guidOf(`comment ${guid}`)}">${made}${element("Comment", escaped(comment))}<Viewpoint Guid="${viewGuid}"/></Comment></Comments>`
    : "";
  return (
    `<Markup><Header><Files><File IsExternal="true">${element("Filename", escaped(model.file))}</File></Files></Header>` +
    `<Topic Guid="${guid}" TopicType="View" TopicStatus="${escaped(status)}">${element("Title", escaped(name))}${element("CreationDate", date.toISOString())}${element("CreationAuthor", escaped(author))}${comments}` +
    `<Viewpoints><ViewPoint Guid="${viewGuid}">${element("Viewpoint", "viewpoint.bcfv")}${hasPicture ? element("Snapshot", "snapshot.png") : ""}</ViewPoint></Viewpoints></Topic></Markup>`
  );
}

async function viewpoint(state: ViewState, model: BcfModel, guid: string): Promise<string> {
  return `<VisualizationInfo Guid="${guid}">${await components(state, model)}${cameraOf(state.camera, model)}${planes(state.sections, model)}</VisualizationInfo>`;
}

/** A query that selects nothing now does not hide anything. */
async function selected(model: BcfModel, queries: string[]): Promise<Set<string>> {
  const found = new Set<string>();
  for (const query of queries) for (const id of await model.engine.select(query).catch(() => [])) found.add(id);
  return found;
}

async function components(state: ViewState, model: BcfModel): Promise<string> {
  const solids = model.index.features.filter((feature) => feature.count > 0).map(({ id }) => id);
  const hidden = await selected(model, state.hide);
  const shown = state.show.length ? await selected(model, state.show) : null;
  const isSeen = (id: string) => !hidden.has(id) && (!shown || shown.has(id));
  const seen = solids.filter(isSeen);
  const isShownByDefault = seen.length * 2 >= solids.length;
  const exceptions = isShownByDefault ? solids.filter((id) => !isSeen(id)) : seen;
  const component = (id: string) =>
    kIfcId.test(id)
      ? `<Component IfcGuid="${id}"/>`
      : element("Component", element("OriginatingSystem", "SVT") + element("AuthoringToolId", escaped(id)));
  const list = (name: string, ids: string[]) => (ids.length ? element(name, ids.map(component).join("")) : "");
  let colors = "";
  for (const { select, color } of state.styles) {
    const ids = color ? [...(await selected(model, [select]))] : [];
    if (ids.length) colors += `<Color Color="${color!.slice(1).toUpperCase()}">${list("Components", ids)}</Color>`;
  }
  return element(
    "Components",
    list("Selection", state.selection) +
      `<Visibility DefaultVisibility="${isShownByDefault}"><ViewSetupHints SpacesVisible="true" SpaceBoundariesVisible="true" OpeningsVisible="true"/>${list("Exceptions", exceptions)}</Visibility>` +
      (colors ? element("Coloring", colors) : ""),
  );
}

function cameraOf(camera: Camera | null, { info, aspect, box }: BcfModel): string {
  const seen: Camera = camera ?? {
    eye: add(box.high, [10, -10, 10]),
    target: scale(box.high, 0.5),
    parallel: false,
    height: 10,
    fieldOfView: kSceneMembers["/camera/fieldOfView"].default,
  };
  const { forward, up } = basisOf(seen);
  const common = xyz("CameraViewPoint", add(seen.eye, info.origin)) + xyz("CameraDirection", forward) + xyz("CameraUpVector", up);
  const last = element("AspectRatio", aspect.toFixed(6));
  return seen.parallel
    ? element("OrthogonalCamera", common + element("ViewToWorldScale", String(seen.height)) + last)
    : element("PerspectiveCamera", common + element("FieldOfView", String(seen.fieldOfView)) + last);
}

function planes(sections: Section[], { info, box }: BcfModel): string {
  if (!sections.length) return "";
  return element(
    "ClippingPlanes",
    sections
      .map((section) => {
        const normal = normalOf(section, box);
        const direction = scale(normal, section.flip ? -1 : 1);
        return element("ClippingPlane", xyz("Location", add(info.origin, scale(normal, section.at))) + xyz("Direction", direction));
      })
      .join(""),
  );
}

/** The views of a BCF file of version 2.1 or 3.0, and the number of its components that the model lacks. Rejects other files. */
export async function viewsOfBcf(bytes: ArrayBuffer, model: BcfModel): Promise<{ views: Bookmark[]; missing: number }> {
  const files = await unzipped(bytes);
  const views: Bookmark[] = [];
  let missing = 0;
  for (const [name, content] of files) {
    if (!/(^|\/)markup\.bcf$/.test(name)) continue;
    const folder = name.slice(0, -"markup.bcf".length);
    const topic = parsed(content);
    const title = topic.querySelector("Topic > Title")?.textContent?.trim() || folder;
    // In 2.1, viewpoints are siblings of the topic.
    const points = [...topic.querySelectorAll("ViewPoint, Markup > Viewpoints")].filter((point) =>
      point.querySelector(":scope > Viewpoint"),
    );
    for (const [n, point] of points.entries()) {
      const file = files.get(folder + point.querySelector(":scope > Viewpoint")!.textContent!.trim());
      if (!file) continue;
      const read = stateOf(parsed(file), model);
      missing += read.missing;
      const picture = files.get(folder + (point.querySelector(":scope > Snapshot")?.textContent?.trim() ?? ""));
      const small = picture && (await smallPicture(picture));
      views.push({
        name: points.length > 1 ? `${title} ${n + 1}` : title,
        state: read.state,
        ...(small ? { picture: small } : {}),
        ...textsOf(topic),
      });
    }
  }
  return { views, missing };
}

/** Comments, author, status and day of a topic. In 2.1, comments are siblings of the topic. */
function textsOf(topic: Document): Pick<Bookmark, "comment" | "author" | "status" | "date"> {
  const text = (selector: string) => topic.querySelector(selector)?.textContent?.trim() ?? "";
  const comments = [...topic.querySelectorAll("Comment > Comment")].map((comment) => comment.textContent?.trim()).filter(Boolean);
  const given = {
    comment: comments.join("\n") || text("Topic > Description"),
    author: text("Topic > CreationAuthor"),
    status: topic.querySelector("Topic")?.getAttribute("TopicStatus") ?? "",
    date: /^\d{4}-\d\d-\d\d/.exec(text("Topic > CreationDate"))?.[0] ?? "",
  };
  return Object.fromEntries(Object.entries(given).filter(([, value]) => value));
}

/** A snapshot in the size of bookmarks, cut to their shape, as a data URL; null: the browser cannot read it. */
async function smallPicture(bytes: Uint8Array): Promise<string | null> {
  try {
    const [width, height] = kSmallPicture;
    const picture = await createImageBitmap(new Blob([bytes as Uint8Array<ArrayBuffer>]));
    const canvas = new OffscreenCanvas(width, height);
    const share = Math.max(width / picture.width, height / picture.height);
    const [w, h] = [picture.width * share, picture.height * share];
    canvas.getContext("2d")!.drawImage(picture, (width - w) / 2, (height - h) / 2, w, h);
    return dataUrl(new Uint8Array(await (await canvas.convertToBlob({ type: "image/png" })).arrayBuffer()));
  } catch {
    return null;
  }
}

function parsed(content: Uint8Array): Document {
  const xml = new DOMParser().parseFromString(new TextDecoder().decode(content), "application/xml");
  if (xml.querySelector("parsererror")) throw new Error("damaged XML");
  return xml;
}

const numberIn = (of: Element | null, name: string): number => Number(of?.querySelector(`:scope > ${name}`)?.textContent ?? NaN);
function pointIn(of: Element | null, name: string): Point | null {
  const found = of?.querySelector(`:scope > ${name}`) ?? null;
  const p = [numberIn(found, "X"), numberIn(found, "Y"), numberIn(found, "Z")] as Point;
  return p.every(Number.isFinite) ? p : null;
}

function stateOf(view: Document, model: BcfModel): { state: ViewState; missing: number } {
  const { index, info, box } = model;
  let missing = 0;
  const idsIn = (selector: string) =>
    [...view.querySelectorAll(`${selector} > Component`)].flatMap((component) => {
      const ids = [component.getAttribute("IfcGuid"), component.querySelector("AuthoringToolId")?.textContent?.trim()];
      const known = ids.find((id) => id && index.byId.has(id));
      if (!known) ++missing;
      return known ? [known] : [];
    });
  const state = initialState();
  state.camera = cameraIn(view, model);
  state.selection = idsIn("Selection");
  const visibility = view.querySelector("Visibility");
  const exceptions = idsIn("Exceptions").map(ofId);
  if (visibility?.getAttribute("DefaultVisibility") === "true") {
    state.hide = exceptions;
    const hints = visibility.querySelector("ViewSetupHints") ?? view.querySelector("ViewSetupHints");
    if (hints && hints.getAttribute("SpacesVisible") !== "true" && index.classes.has("BuildingRoom"))
      state.hide = [...exceptions, ofClass("BuildingRoom")];
  } else if (exceptions.length) state.show = exceptions;
  state.styles = [...view.querySelectorAll("Coloring > Color")].flatMap((color) => {
    const hex = (color.getAttribute("Color") ?? "").slice(-6).toLowerCase();
    if (!/^[0-9a-f]{6}$/.test(hex)) return [];
    const ids = [...color.querySelectorAll("Component")].map(
      (component) => component.getAttribute("IfcGuid") ?? component.querySelector("AuthoringToolId")?.textContent?.trim() ?? "",
    );
    return ids.filter((id) => index.byId.has(id)).map((id) => ({ select: ofId(id), color: `#${hex}` }));
  });
  state.sections = [...view.querySelectorAll("ClippingPlane")].flatMap((plane) => {
    const at = pointIn(plane, "Location"),
      direction = pointIn(plane, "Direction");
    return at && direction && dot(direction, direction) > 0 ? [sectionOf(sub(at, info.origin), normalized(direction), box)] : [];
  });
  return { state, missing };
}

function sectionOf(at: Point, direction: Point, box: Box): Section {
  for (const [i, axis] of (["x", "y", "z"] as const).entries()) {
    const along = dot(box.axes[i]!, direction);
    if (Math.abs(along) > 1 - 1e-9) return { axis, at: dot(box.axes[i]!, at), flip: along < 0, turn: 45, tilt: 0 };
  }
  const degrees = 180 / Math.PI;
  return {
    axis: "free",
    at: dot(direction, at),
    flip: false,
    turn: Math.atan2(direction[1], direction[0]) * degrees,
    tilt: Math.asin(Math.min(1, Math.max(-1, direction[2]))) * degrees,
  };
}

/** The camera shows everything that the other picture shows, even if the pictures have different shapes. */
function cameraIn(view: Document, { info, aspect, box }: BcfModel): Camera | null {
  const found = view.querySelector("PerspectiveCamera, OrthogonalCamera");
  const eye = pointIn(found, "CameraViewPoint"),
    direction = pointIn(found, "CameraDirection");
  if (!found || !eye || !direction || dot(direction, direction) === 0) return null;
  const wider = Math.max(1, (numberIn(found, "AspectRatio") || 1) / aspect);
  const from = sub(eye, info.origin),
    along = normalized(direction);
  const middle = scale(add(box.low, box.high), 0.5);
  const reach = Math.max(1, dot(sub(middle, from), along));
  const parallel = found.nodeName === "OrthogonalCamera";
  const given = numberIn(found, "FieldOfView");
  const opened = (2 * Math.atan(Math.tan((given * Math.PI) / 360) * wider) * 180) / Math.PI;
  const fieldOfView = !parallel && isAllowed("/camera/fieldOfView", opened) ? opened : kSceneMembers["/camera/fieldOfView"].default;
  const height = parallel ? Math.max(1e-3, numberIn(found, "ViewToWorldScale") * wider || 10) : 10;
  return { eye: from, target: add(from, scale(along, reach || 1)), parallel, height, fieldOfView };
}
