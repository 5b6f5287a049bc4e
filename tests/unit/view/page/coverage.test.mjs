import assert from "node:assert/strict";
import test from "node:test";
import { pixelsOf } from "../../../../view/page/src/world/coverage_pixels.js";

test("each cell has the colour of its class, and none where nothing is received", () => {
  const classes = [{ label: "weak", colour: "#440154" }, { label: "strong", colour: "#fde725" }];
  const pixels = pixelsOf({ columns: 2, rows: 2 }, { classes, cells: [0, 1, -1, 0] });
  assert.deepEqual([...pixels], [0x44, 0x01, 0x54, 255, 0xfd, 0xe7, 0x25, 255, 0, 0, 0, 0, 0x44, 0x01, 0x54, 255]);
});
