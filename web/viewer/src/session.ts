/** The state of the page in parts. They are made in this order: a part knows only parts above it. */

import type { Engine } from "./engine";
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
    view.hasFaces = (await volume.engine?.prepare().catch(() => false)) ?? false;
    if (view.hasFaces) view.redraw();
  }
}
