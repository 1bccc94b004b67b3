// SPDX-License-Identifier: LGPL-3.0-or-later
//
// How detailed the pictures are while the view moves. It is measured how long the graphics take for a picture;
// where that is long, pictures have fewer triangles and pixels until the view rests.

const slow = 90;   ///< milliseconds for a picture that make the next ones simpler
const wanted = 45; ///< milliseconds that a simpler picture should take

/** Triangles that are drawn at most, about, by level; level 0 has all. */
export const budgets = [Infinity, 160_000, 40_000, 10_000];
const mostGuessed = 2; ///< the highest level that follows from a picture at level 0 alone

export class Pace {
  level = 0;   ///< of the pictures that are drawn now
  learned = 0; ///< of those that are drawn while the view moves
  whole = 0;   ///< milliseconds that the last picture at level 0 took
  private total = 0; ///< triangles at level 0
  private moving = false;
  private measuring = false;
  private rest: number | undefined;

  constructor(private readonly graphics: WebGL2RenderingContext, private readonly setLevel: (level: number) => void) {}

  /** Notes that the view moves. It rests once it has not moved for a while, which is longer where pictures take long. */
  moved(): void {
    this.moving = true;
    this.use(this.learned);
    this.restartRest();
  }
  private restartRest(): void {
    clearTimeout(this.rest);
    this.rest = window.setTimeout(() => {
      this.moving = false;
      this.use(0);
    }, 300 + Math.min(this.whole / 4, 700));
  }
  /** Draws all from now on, until the view moves again. */
  stop(): void {
    clearTimeout(this.rest);
    this.moving = false;
    this.use(0);
  }
  private use(level: number): void {
    if (level === this.level) return;
    this.level = level;
    this.setLevel(level);
  }

  /** Notes that the commands for a picture of so many triangles were given, and measures when they are done. */
  drawn(triangles: number): void {
    if (this.moving) this.restartRest();
    if (this.measuring) return;
    const { graphics, level } = this, begun = performance.now();
    const done = graphics.fenceSync(graphics.SYNC_GPU_COMMANDS_COMPLETE, 0);
    if (!done) return;
    graphics.flush();
    this.measuring = true;
    const look = () => {
      if (graphics.getSyncParameter(done, graphics.SYNC_STATUS) !== graphics.SIGNALED && !graphics.isContextLost()) {
        window.setTimeout(look, 4);
        return;
      }
      graphics.deleteSync(done);
      this.measuring = false;
      this.judge(performance.now() - begun, level, triangles);
    };
    window.setTimeout(look, 1);
  }

  /**
   * Learns from the time that a picture took. Pictures become simpler at once, and richer when the view moves again.
   * How much of the time depends on triangles and how much on pixels is not known: after the first guess, levels change by one.
   */
  judge(milliseconds: number, level: number, triangles: number): void {
    if (level === 0) [this.whole, this.total] = [milliseconds, triangles];
    if (milliseconds > slow && level >= this.learned && level + 1 < budgets.length) {
      const each = milliseconds / Math.max(triangles, 1);
      const guess = budgets.findIndex((budget) => budget * each <= wanted);
      this.learned = level > 0 ? level + 1 : guess > 0 ? Math.min(guess, mostGuessed) : mostGuessed;
      if (this.moving) this.use(this.learned);
    } else if (level > 0 && level === this.learned) {
      const richer = Math.min(budgets[level - 1], this.total) / Math.min(budgets[level], this.total);
      if (milliseconds * Math.max(richer, 4) <= wanted) this.learned = level - 1;
    }
  }
}
