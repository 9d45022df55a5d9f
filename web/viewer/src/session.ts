/** The state of the page in parts. They are made in this order: a part knows only parts above it. */

import type { Engine, VolumeInfo } from "./engine";
import { Languages } from "./languages";
import { effect, untracked } from "./observable";
import { Address } from "./session/address";
import { Answers } from "./session/answers";
import { Messages } from "./session/messages";
import { Model } from "./session/model";
import { OpenVolume } from "./session/open_volume";
import { Selection } from "./session/selection";
import { ShownPicture } from "./session/shown_picture";
import { View } from "./session/view";

export class Session {
  readonly messages = new Messages();
  readonly languages = new Languages(this.messages);
  readonly volume = new OpenVolume();
  readonly answers = new Answers(this.volume);
  readonly view = new View(this.volume, this.messages, this.answers);
  readonly selection = new Selection(this);
  readonly picture = new ShownPicture(this);
  readonly address = new Address(this.volume, this.view);
  readonly model = new Model(this);
  /** The model that was open when the library was last prepared; the next one tries again after a failure. */
  private preparedFor: VolumeInfo | null = null;

  constructor() {
    effect(() => {
      const { hide, show } = this.view.now;
      if (this.volume.info) untracked(() => void this.answers.find([...hide, ...show]));
    });
  }

  start(engine: Engine): void {
    this.volume.engine = engine;
    this.picture.start(engine, (error) => void this.model.reopen(error));
    if (this.model.status === "starting") this.model.status = "empty";
  }

  /** Loads the rest of the library; from then on, a picture at rest shows the faces of the model. */
  async prepareFaces(): Promise<void> {
    const { view, volume } = this;
    if (view.hasFaces || this.preparedFor === volume.info || !volume.engine) return;
    this.preparedFor = volume.info;
    try {
      view.hasFaces = await volume.engine.prepare();
      if (view.hasFaces) view.redraw();
    } catch {
      // The worker was replaced meanwhile: the next call tries again.
      this.preparedFor = null;
    }
  }
}
