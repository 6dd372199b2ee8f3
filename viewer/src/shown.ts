// SPDX-License-Identifier: Apache-2.0
// What the page keeps of the view that it shows.
import type { ReportPack } from './report';

export interface Shown {
  /** Ends the view; its elements are taken away by the page. */
  stop: () => void;
  /** Takes fresh data of a watched run, and leaves as it is what a reader has chosen. */
  renew: (pack: ReportPack) => void;
  /** Draws in the colours of another theme what is not the style sheet's, and leaves all else. */
  recolour: () => void;
}
