/** The base class of parts that follow the view of the open model. */

import { Observable } from "../observable";
import type { Messages } from "./messages";
import type { OpenVolume } from "./open_volume";
import type { View } from "./view";

export interface ViewParts {
  volume: OpenVolume;
  view: View;
  messages: Messages;
}

export abstract class ViewPart extends Observable {
  protected readonly volume: OpenVolume;
  protected readonly view: View;
  protected readonly messages: Messages;

  constructor({ volume, view, messages }: ViewParts) {
    super();
    this.volume = volume;
    this.view = view;
    this.messages = messages;
  }
}
