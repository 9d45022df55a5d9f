/** Public types of `<svt-viewer>`: the details of its events, and the arguments of its methods. */

import type { EngineError, Pick, VolumeInfo } from "../engine";
import type { Camera } from "../state/view_state";

/** The first picture of a model is visible. */
export interface LoadDetail {
  info: VolumeInfo;
  /** Threads that draw together; 1 if the page is not isolated (COOP, COEP). */
  threads: number;
}

export interface ProgressDetail {
  /** The present step, in the language of the element. */
  text: string;
  /** 0 to 1; negative: unknown. */
  share: number;
}

/** The visitor clicked on the picture. preventDefault() keeps the selection as it is. */
export interface PickDetail {
  /** null: nothing is there. */
  pick: Pick | null;
  /** CSS pixels from the upper left corner of the element. */
  x: number;
  y: number;
  /** Ids of the selected features before the click. */
  selection: string[];
}

export interface CameraDetail {
  camera: Camera;
}

/** `code` as in the manual; empty: not an error of the library, such as a file that cannot be fetched. */
export type ErrorDetail = EngineError;

export interface SvtViewerEventMap {
  load: CustomEvent<LoadDetail>;
  progress: CustomEvent<ProgressDetail>;
  pick: CustomEvent<PickDetail>;
  camerachange: CustomEvent<CameraDetail>;
  error: CustomEvent<ErrorDetail>;
}

/** Pixels; absent: those of the element. */
export interface PictureSize {
  width?: number;
  height?: number;
}
