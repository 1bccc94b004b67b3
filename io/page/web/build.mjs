// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Bundles the page: node build.mjs PACKAGES SOURCES OUT.cpp [SCRIPT.js STYLE.css]
//
// PACKAGES is a folder in which `npm ci` was run, SOURCES the folder of this file. OUT.cpp defines
// terrane::page::bundle(). The licences of all packages in the bundle go into the script.
import { createRequire } from "node:module";
import { mkdirSync, readFileSync, readdirSync, writeFileSync, rmSync, cpSync } from "node:fs";
import { join, resolve } from "node:path";

const [packages, sources, target, scriptFile, styleFile] = process.argv.slice(2).map((p) => resolve(p));
const require = createRequire(join(packages, "package.json"));
const { build } = require("esbuild");

/** Returns name, version, licence and its text for each package of which a file is bundled. */
function licencesOf(metafile) {
  const names = new Set();
  for (const [path, input] of Object.entries(metafile.inputs)) {
    const match = /node_modules\/((?:@[^/]+\/)?[^/]+)\//.exec(path);
    if (match && input.bytes > 0) names.add(match[1]);
  }
  return [...names].sort().map((name) => {
    const folder = join(packages, "node_modules", name);
    const about = JSON.parse(readFileSync(join(folder, "package.json"), "utf8"));
    const file = readdirSync(folder).find((f) => /^licen[cs]e/i.test(f));
    if (!file) throw new Error(`${name} has no licence file`);
    return { name, version: about.version, licence: about.license,
             text: readFileSync(join(folder, file), "utf8") };
  });
}

/** Builds with the licences that are known so far. */
function bundle(licences) {
  return build({
    absWorkingDir: packages,
    entryPoints: [join(packages, "src", "main.ts")],
    bundle: true,
    minify: true,
    format: "iife",
    target: ["es2022"],
    charset: "ascii",
    legalComments: "none",
    outdir: join(packages, "out"),
    write: false,
    metafile: true,
    define: { TERRANE_LICENCES: JSON.stringify(licences) },
  });
}

/** Writes bytes as C++ string literals: short ones, as compilers limit them. */
function literals(text) {
  const pieces = [];
  for (let i = 0; i < text.length; i += 4000)
    pieces.push('"' + text.slice(i, i + 4000).replace(/[\\"?]/g, (c) => "\\" + c)
      .replace(/[\n\r\t]/g, (c) => ({ "\n": "\\n", "\r": "\\r", "\t": "\\t" })[c]) + '"');
  return pieces.join("\n    ") || '""';
}

// Sources must lie beside the packages, where the bundler looks for these.
rmSync(join(packages, "src"), { recursive: true, force: true });
mkdirSync(packages, { recursive: true });
cpSync(join(sources, "src"), join(packages, "src"), { recursive: true });

const first = await bundle([]);
const { outputFiles } = await bundle(licencesOf(first.metafile));
const contents = (ending) => outputFiles.find((f) => f.path.endsWith(ending)).text.trimEnd();
const script = contents(".js"), style = contents(".css");
for (const [text, end] of [[script, /<\/script/i], [style, /<\/style/i]])
  if (end.test(text)) throw new Error(`the bundle contains ${end}, which would end its element`);
for (const text of [script, style])
  if (/[^\x09\x0a\x20-\x7e]/.test(text)) throw new Error("the bundle is not plain ASCII");

writeFileSync(target, `// SPDX-License-Identifier: LGPL-3.0-or-later
// Made by io/page/web/build.mjs.
#include <terrane/io/page/page_bundle.hpp>

namespace terrane::page {
namespace {

constexpr char page_script[] =
    ${literals(script)};
constexpr char page_style[] =
    ${literals(style)};
constexpr Bundle page_bundle{{page_script, sizeof page_script - 1}, {page_style, sizeof page_style - 1}};

} // namespace

const Bundle* bundle() {
    return &page_bundle;
}

std::string_view bundle_missing() {
    return "";
}

} // namespace terrane::page
`);
if (scriptFile) writeFileSync(scriptFile, script);
if (styleFile) writeFileSync(styleFile, style);
