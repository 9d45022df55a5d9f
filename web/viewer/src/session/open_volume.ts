/** The library and its open model: only data, which Model and CityStream change and other parts read. */

import { boxOf, type Box } from "../camera/camera";
import type { Engine, VolumeInfo } from "../engine";
import { computed, Observable } from "../observable";
import { indexFeatures, type FeatureIndex } from "../state/feature_index";

export interface ListedModel {
  name: string;
  file: string;
  bytes: number;
  title?: string;
  /** A city with the folder `file`, which is fetched in parts. */
  city?: boolean;
}

const kUnitBox: Box = {
  low: [0, 0, 0],
  high: [1, 1, 1],
  axes: [
    [1, 0, 0],
    [0, 1, 0],
    [0, 0, 1],
  ],
};

export class OpenVolume extends Observable {
  engine: Engine | null = null;
  /** Pictures only, from the server. */
  isServerOnly = false;
  /** The models of the site. */
  models: ListedModel[] = [];
  /** Name of the open model in `models`; empty: it is not one of them. */
  name = "";
  /** File name for generated commands. */
  file = "model.svt";
  /** Names of the files that were opened with it. */
  otherFiles: string[] = [];
  /** It is a file of this computer, which links cannot open. */
  isLocal = false;
  /** The names of two states, if the open volume is their difference. */
  compared: { old: string; new: string } | null = null;
  /** null: nothing is open. */
  info: VolumeInfo | null = null;
  /** The library has lost the model that the page shows. Until it has opened the model again, nothing is drawn. */
  isLost = false;
  /** The box of a city is that of its first tile; other tiles do not change it. */
  box: Box = kUnitBox;

  private readonly indexed = computed(() => indexFeatures(this.info?.features ?? []));

  get index(): FeatureIndex {
    return this.indexed.value;
  }
  get isCity(): boolean {
    return this.info?.buildings !== undefined;
  }
  /** The address of the open model of the site, relative to the page. */
  get address(): string {
    return this.models.find((model) => model.name === this.name)?.file ?? this.file;
  }
  /** The files that are open. */
  get fileNames(): string[] {
    return [this.file, ...this.otherFiles];
  }

  /** Another model, or the same one with another grid. */
  take(info: VolumeInfo): void {
    this.info = info;
    this.box = boxOf(info);
  }
}
