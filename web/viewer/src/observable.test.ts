import { expect, it } from "vitest";
import { effect, membersOf, Observable, until } from "./observable";

class Room extends Observable {
  size = { width: 2, length: 3, name: "hall" };
  isOpen = false;
  readonly now = membersOf(() => this.size);
  private keys = 0;

  constructor(private readonly storey: number) {
    super();
  }

  get area(): number {
    return this.now.width * this.now.length;
  }
  get isLocked(): boolean {
    return this.storey > 0 && this.keys > 0 && !this.isOpen;
  }
  lock(): void {
    ++this.keys;
  }
}

function seen<T>(read: () => T): T[] {
  const values: T[] = [];
  effect(() => void values.push(read()));
  return values;
}

it("runs an effect again when a value changes that it read, and for nothing else", () => {
  const room = new Room(1),
    other = new Room(1);
  const areas = seen(() => room.area);
  room.size = { ...room.size, width: 4 };
  room.size = { ...room.size, name: "kitchen" };
  room.isOpen = true;
  other.size = { ...other.size, width: 9 };
  expect(areas).toEqual([6, 12]);
  expect(other.area).toBe(27);
});

it("observes what a getter reads, hidden fields as well", () => {
  const room = new Room(1);
  const locked = seen(() => room.isLocked);
  room.lock();
  room.isOpen = true;
  expect(locked).toEqual([false, true, false]);
});

it("has members that can be copied like the object", () => {
  const room = new Room(1);
  expect({ ...room.now, width: 5 }).toEqual({ width: 5, length: 3, name: "hall" });
});

it("waits until a condition holds, and no longer", async () => {
  const room = new Room(1);
  let asked = 0;
  const isOpen = until(() => (++asked, room.isOpen));
  room.isOpen = true;
  await isOpen;
  room.isOpen = false;
  expect(asked).toBe(2);
  await until(() => !room.isOpen);
});
