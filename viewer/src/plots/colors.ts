// SPDX-License-Identifier: Apache-2.0
/** The colors of `coframe plot`: each has a contrast of at least 3.5 with a white and with a dark background. */

export const COLORS = ["#2f7de1", "#d9542b", "#1f9a5b", "#a45ee0", "#a17a12", "#d6497f", "#128f9e", "#7b7f87"] as const;
