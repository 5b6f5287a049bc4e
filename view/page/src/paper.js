// Canvases to draw on. Where the graphics card is only a program (headless browsers, virtual machines), what a
// browser gives it to draw takes ten times as long as if it had drawn by itself; it does so if the canvas is meant
// to be read.
let known = null;

export function hasGraphicsCard() {
  if (known !== null) return known;
  const gl = document.createElement("canvas").getContext("webgl");
  const info = gl?.getExtension("WEBGL_debug_renderer_info");
  const name = gl ? gl.getParameter(info ? info.UNMASKED_RENDERER_WEBGL : gl.RENDERER) : "none";
  gl?.getExtension("WEBGL_lose_context")?.loseContext();
  known = Boolean(gl) && !/swiftshader|llvmpipe|softpipe|software|basic render/i.test(name);
  return known;
}

/** @param little  is drawn on it at a time: then what the card's program does is less than handing it the picture. */
export const paper = (canvas, little = false) => canvas.getContext("2d", { willReadFrequently: !little && !hasGraphicsCard() });
