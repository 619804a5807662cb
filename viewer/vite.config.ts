// SPDX-License-Identifier: Apache-2.0
import { readFileSync } from "node:fs";
import type { Plugin } from "vite";
import { defineConfig } from "vitest/config";

const NOTICE = `/*!
coframe's viewer, Apache-2.0. It contains:
three.js,
${readFileSync("node_modules/three/LICENSE", "utf8").trim()}
*/`;

const PANES_NOTICE = `/*!
The panels of coframe's viewer, Apache-2.0. They contain:
uPlot,
${readFileSync("node_modules/uplot/LICENSE", "utf8").trim()}
dagre,
${readFileSync("node_modules/@dagrejs/dagre/LICENSE", "utf8").trim()}
*/`;

const REPLAY_HEAD =
  `<meta http-equiv="Content-Security-Policy" content="default-src 'none'; script-src 'sha256-%SCRIPT_HASH%'; ` +
  `style-src 'unsafe-inline'; img-src data: blob:; connect-src data: blob:">`;

/**
 * Writes replay.html: the page with a policy that forbids all requests. src/coframe/viewer/replay/_template.py replaces the
 * words between percent signs by page.js, its hash and viewer.css, so that a replay is a single file that opens from disk.
 */
function replayPage(): Plugin {
  return {
    name: "replay-page",
    generateBundle: {
      order: "post",
      handler(_options, bundle) {
        const page = bundle["index.html"];
        if (page?.type !== "asset") throw new Error("The build contains no index.html.");
        const source = String(page.source)
          .replace("<head>", `<head>\n    ${REPLAY_HEAD}`)
          .replace(/ *<script type="module"[^>]*><\/script>\n/, "")
          .replace(/ *<link rel="modulepreload"[^>]*>\n/, "")
          .replace(/<link rel="stylesheet"[^>]*>/, "<style>%STYLE%</style>")
          .replace(
            "</body>",
            `  <script type="application/json" id="replay">%RECORDING%</script>\n` +
              `    <script type="module">%SCRIPT%</script>\n  </body>`,
          );
        this.emitFile({ type: "asset", fileName: "replay.html", source });
      },
    },
  };
}

/** Makes page.js valid inside a script element, which some texts would end or change. */
function inlineScript(): Plugin {
  return {
    name: "inline-script",
    generateBundle(_options, bundle) {
      const page = bundle["assets/page.js"];
      if (page?.type !== "chunk") throw new Error("The build contains no page.js.");
      if (page.imports.length > 0) throw new Error(`page.js imports ${page.imports.join(", ")}.`);
      // The escaped form is the same JavaScript string.
      page.code = page.code.replaceAll("</script", "<\\/script");
      if (page.code.includes("<!--")) throw new Error("page.js contains the start of an HTML comment.");
    },
  };
}

/** Preloads the second script, which the first one imports only when it runs. */
function preload(): Plugin {
  return {
    name: "preload",
    transformIndexHtml: (html) =>
      html.replace("</head>", `  <link rel="modulepreload" href="./assets/page.js" />\n  </head>`),
  };
}

/** The build of the page itself, which replays contain, is `vite build --mode page`; the other one builds what loads it. */
export default defineConfig(({ command, mode }) => {
  const isPage = mode === "page";
  return {
    base: "./",
    publicDir: false,
    plugins: isPage ? [inlineScript()] : [preload(), replayPage()],
    build: {
      outDir: "../src/coframe/viewer/static",
      emptyOutDir: !isPage,
      target: "es2022",
      modulePreload: false,
      cssCodeSplit: false,
      chunkSizeWarningLimit: 2000,
      // The names are fixed, so that a rebuild gives the same files. The server uses ETags for caching.
      rollupOptions: {
        ...(isPage
          ? { input: { page: "src/page.ts" }, preserveEntrySignatures: "allow-extension" as const }
          : { external: command === "build" ? /\/page$/ : [] }),
        output: {
          ...(isPage ? {} : { paths: (id: string) => (id.endsWith("/page") ? "./assets/page.js" : id) }),
          postBanner: ({ name }) => (name === "panes" ? PANES_NOTICE : name === "page" ? NOTICE : ""),
          entryFileNames: isPage ? "assets/page.js" : "assets/viewer.js",
          chunkFileNames: "assets/[name].js",
          assetFileNames: "assets/viewer[extname]",
        },
      },
    },
    test: { include: ["test/**/*.test.ts"] },
  };
});
