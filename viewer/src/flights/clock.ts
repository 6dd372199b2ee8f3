// SPDX-License-Identifier: Apache-2.0
// The time that is shown.

export const SPEEDS = [0.1, 0.25, 0.5, 1, 2, 4, 8];

export class Clock {
  time = 0;
  speed = 1;
  isPlaying = false;

  constructor(public end: number) {}

  /** Goes on by `seconds` of the watcher's; stops at the end. */
  advance(seconds: number): void {
    if (!this.isPlaying) return;
    this.time += seconds * this.speed;
    if (this.time < this.end) return;
    this.time = this.end;
    this.isPlaying = false;
  }

  /** Plays, from the beginning if it is at the end, or stops. */
  toggle(): void {
    if (!this.isPlaying && this.time >= this.end) this.time = 0;
    this.isPlaying = !this.isPlaying;
  }

  seek(time: number): void {
    this.time = Math.min(Math.max(time, 0), this.end);
  }

  /** The next speed up (1) or down (-1). */
  shift(step: number): void {
    const place = SPEEDS.indexOf(this.speed) + step;
    this.speed = SPEEDS[Math.min(Math.max(place, 0), SPEEDS.length - 1)];
  }
}
