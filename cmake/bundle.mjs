// Builds a page, of the report or of the view: index.html with the style and the bundled script in it.
// The script is a classic one (esbuild's iife): a page opened from disk may load no modules.
//   node bundle.mjs OUTPUT     in a folder with index.html, style.css, src and node_modules
import { readFileSync, writeFileSync } from "node:fs";
import { build } from "esbuild";

const folder = new URL(".", import.meta.url);
const read = (name) => readFileSync(new URL(name, folder), "utf8");
const { outputFiles, metafile } = await build({
  absWorkingDir: folder.pathname,
  entryPoints: ["src/main.js"],
  bundle: true,
  minify: true,
  write: false,
  metafile: true,
  legalComments: "none",
  target: "es2020",
});
const script = outputFiles[0].text.replaceAll("</script", "<\\/script");

// The licences of what was bundled travel with it: each text once, with the packages it is for.
const packages = new Map();
for (const input of Object.keys(metafile.inputs)) {
  const name = input.match(/^node_modules\/([^/]+)/)?.[1];
  if (!name) continue;
  const text = read(`node_modules/${name}/LICENSE`).trim();
  packages.set(text, (packages.get(text) ?? new Set()).add(name));
}
const licences = [...packages].map(([text, names]) => `${[...names].join(", ")}\n${text}`).join("\n\n");

const page = read("index.html")
  .replace("/* STYLE */", () => read("style.css"))
  .replace("/* SCRIPT */", () => `/* With parts of others:\n\n${licences.replaceAll("*/", "* /")}\n*/\n${script}`);
writeFileSync(process.argv[2], page);
