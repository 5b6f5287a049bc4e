// Builds the page without figures: index.html with the style and the bundled script in it.
//   node bundle.mjs OUTPUT
import { readFileSync, writeFileSync } from "node:fs";
import { build } from "esbuild";

const folder = new URL(".", import.meta.url);
const read = (name) => readFileSync(new URL(name, folder), "utf8");
const { outputFiles } = await build({
  absWorkingDir: folder.pathname,
  entryPoints: ["src/main.js"],
  bundle: true,
  minify: true,
  write: false,
  legalComments: "none",
  target: "es2020",
});
const script = outputFiles[0].text.replaceAll("</script", "<\\/script");
const licences = ["array", "axis", "path", "scale", "selection", "shape"]
  .map((part) => `d3-${part}`).join(", ");
const page = read("index.html")
  .replace("/* STYLE */", () => read("style.css"))
  .replace("/* SCRIPT */", () => `/* With parts of D3 (${licences} and what they need),
   Copyright Mike Bostock, ISC licence: https://d3js.org */
${script}`);
writeFileSync(process.argv[2], page);
