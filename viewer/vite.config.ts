// SPDX-License-Identifier: Apache-2.0
import { createHash } from 'node:crypto';
import { defineConfig, type Plugin } from 'vite';

/** A source of the Content-Security-Policy that allows exactly this inline text. */
function hashOf(text: string): string {
  return `'sha256-${createHash('sha256').update(text, 'utf8').digest('base64')}'`;
}

/**
 * Makes the page one file, report.html: script and style inline, and a policy that allows them by
 * their hashes, and nothing else to run, to be styled by, or to be fetched.
 */
function oneFile(): Plugin {
  return {
    name: 'skein-one-file',
    enforce: 'post',
    generateBundle(_options, bundle) {
      let script = '';
      let style = '';
      let html = '';
      for (const [name, output] of Object.entries(bundle)) {
        if (output.type === 'chunk') script += output.code;
        else if (name.endsWith('.css')) style += output.source;
        else if (name.endsWith('.html')) html = String(output.source);
        delete bundle[name];
      }
      script = script.replace(/<\/script/gi, '<\\/script').replace(/<!--/g, '<\\!--');
      const policy = [
        "default-src 'none'", `script-src ${hashOf(script)}`, `style-src ${hashOf(style)}`,
        'img-src data: blob:', "connect-src 'none'", "base-uri 'none'", "form-action 'none'",
      ].join('; ');
      const head = `<meta http-equiv="Content-Security-Policy" content="${policy}">`;
      html = html
        .replace(/\s*<script type="module"[^>]*><\/script>/g, '')
        .replace(/\s*<link rel="stylesheet"[^>]*>/g, '')
        .replace('<meta charset="utf-8">', (charset) => `${charset}\n${head}`)
        .replace('</head>', () => `<style>${style}</style>\n</head>`)
        .replace('</body>', () => `<script type="module">${script}</script>\n</body>`);
      this.emitFile({ type: 'asset', fileName: 'report.html', source: html });
    },
  };
}

export default defineConfig({
  plugins: [oneFile()],
  build: {
    // As docs/how-to/report.md says.
    target: ['chrome92', 'firefox113', 'safari16.4'],
    outDir: process.env.SKEIN_VIEWER_OUT ?? 'dist',
    emptyOutDir: false,
    assetsInlineLimit: 0,
    modulePreload: false,
    chunkSizeWarningLimit: 2000,
  },
});
