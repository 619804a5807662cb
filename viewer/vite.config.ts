// SPDX-License-Identifier: Apache-2.0
import { createHash } from "node:crypto";
import { readFileSync } from "node:fs";
import type { Plugin } from "vite";
import { defineConfig } from "vitest/config";

const NOTICE = `/*!
coframe's viewer, Apache-2.0. It contains:
urdf-loader, Apache-2.0, the California Institute of Technology and others
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

/** Inlines the script and the style sheet, so that a replay is a single file that opens from disk. */
function oneFile(): Plugin {
  return {
    name: "one-file",
    enforce: "post",
    // Vite must insert the preload list of dynamic imports first.
    generateBundle: {
      order: "post",
      handler(_options, bundle) {
        const page = bundle["index.html"];
        if (page?.type !== "asset") throw new Error("The build contains no index.html.");
        let html = String(page.source);
        for (const [name, part] of Object.entries(bundle)) {
          if (part.type === "chunk") {
            // `</script` would end the element early. The escaped form is the same JavaScript string.
            const code = part.code.replaceAll("</script", "<\\/script");
            const hash = createHash("sha256").update(code).digest("base64");
            html = html
              .replace(/<script type="module"[^>]*><\/script>/, "")
              .replace("%SCRIPT_HASH%", () => `sha256-${hash}`)
              .replace("</body>", () => `<script type="module">${code}</script></body>`);
          } else if (name.endsWith(".css")) {
            html = html.replace(/<link rel="stylesheet"[^>]*>/, () => `<style>${String(part.source)}</style>`);
          } else continue;
          delete bundle[name];
        }
        page.source = html;
        page.fileName = "replay.html";
      },
    },
  };
}

const REPLAY_HEAD =
  `<meta http-equiv="Content-Security-Policy" content="default-src 'none'; script-src '%SCRIPT_HASH%'; ` +
  `style-src 'unsafe-inline'; img-src data: blob:; connect-src data: blob:">`;

/** Adds what distinguishes a replay from the live page: a policy that forbids all requests, and the recording. */
function replayPage(): Plugin {
  return {
    name: "replay-page",
    transformIndexHtml: (html) =>
      html
        .replace("<head>", `<head>\n    ${REPLAY_HEAD}`)
        .replace("</body>", `  <script type="application/json" id="replay">null</script>\n  </body>`),
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

export default defineConfig(({ mode }) => {
  const replay = mode === "replay";
  return {
    base: "./",
    publicDir: false,
    plugins: replay ? [replayPage(), oneFile()] : [preload()],
    build: {
      outDir: "../src/coframe/viewer/static",
      emptyOutDir: !replay,
      target: "es2022",
      modulePreload: false,
      cssCodeSplit: false,
      chunkSizeWarningLimit: 2000,
      // The names are fixed, so that a rebuild gives the same files. The server uses ETags for caching.
      rollupOptions: {
        output: {
          codeSplitting: !replay,
          postBanner: ({ name }) => (name === "panes" ? PANES_NOTICE : replay || name === "page" ? NOTICE : ""),
          entryFileNames: "assets/viewer.js",
          chunkFileNames: "assets/[name].js",
          assetFileNames: "assets/viewer[extname]",
        },
      },
    },
    test: { include: ["test/**/*.test.ts"] },
  };
});
