/** Public types of the library. */

export type { OpenSettings, Source, Volume } from "./volume";
export type {
  CameraPreset,
  ColorScale,
  DrawingFormat,
  DrawingParts,
  Effects,
  EngineError,
  Feature,
  FeatureProperties,
  Point,
  Scene,
  SceneCamera,
  VolumeInfo,
} from "../engine";
