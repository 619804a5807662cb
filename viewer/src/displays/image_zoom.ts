// SPDX-License-Identifier: Apache-2.0
/** Zooms and pans an image inside its frame: wheel, drag, and double-click for the whole image. */

const MAX_ZOOM = 64;
const ZOOM_PER_PIXEL = 0.002;

export class ImageZoom {
  /** 1 shows the whole image. */
  factor = 1;
  /** The position of the image's top left corner, in parts of the frame's size, which may change. */
  private left = 0;
  private top = 0;
  /** The factor that a double-click restores. */
  private usual = 1;

  /**
   * @param frame The element that shows a part of the content.
   * @param content The element that is zoomed, which fills the frame at first.
   */
  constructor(
    private readonly frame: HTMLElement,
    private readonly content: HTMLElement,
    private readonly onChange: () => void,
  ) {
    frame.addEventListener("wheel", (event) => this.onWheel(event), { passive: false });
    frame.addEventListener("pointerdown", (event) => {
      if (this.factor > 1) frame.setPointerCapture(event.pointerId);
    });
    frame.addEventListener("pointermove", (event) => {
      if (frame.hasPointerCapture(event.pointerId)) this.move(event.movementX, event.movementY);
    });
    frame.addEventListener("dblclick", () => this.reset());
  }

  /** Zooms to the middle of the image; 1 shows all of it. */
  reset(factor = this.usual): void {
    this.usual = factor;
    this.factor = factor;
    this.left = this.top = (1 - factor) / 2;
    this.apply();
  }

  private onWheel(event: WheelEvent): void {
    event.preventDefault();
    const bounds = this.frame.getBoundingClientRect();
    const [x, y] = [(event.clientX - bounds.left) / bounds.width, (event.clientY - bounds.top) / bounds.height];
    const factor = Math.max(1, Math.min(MAX_ZOOM, this.factor * Math.exp(-event.deltaY * ZOOM_PER_PIXEL)));
    // The point under the pointer stays where it is.
    this.left = x - ((x - this.left) * factor) / this.factor;
    this.top = y - ((y - this.top) * factor) / this.factor;
    this.factor = factor;
    this.apply();
  }

  private move(x: number, y: number): void {
    this.left += x / this.frame.clientWidth;
    this.top += y / this.frame.clientHeight;
    this.apply();
  }

  private apply(): void {
    this.left = Math.min(0, Math.max(1 - this.factor, this.left));
    this.top = Math.min(0, Math.max(1 - this.factor, this.top));
    this.content.style.transform =
      this.factor === 1 ? "" : `translate(${100 * this.left}%, ${100 * this.top}%) scale(${this.factor})`;
    this.frame.classList.toggle("zoomed", this.factor > 1);
    this.onChange();
  }
}
