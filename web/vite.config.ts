import { createHash } from 'node:crypto';
import { defineConfig, type Plugin } from 'vite';

// The page is one file: script and style are written into it, and its policy allows nothing else to run or load.
function oneFile(): Plugin {
  return {
    name: 'one-file',
    enforce: 'post',
    generateBundle(_options, bundle) {
      const page = bundle['index.html'];
      if (page?.type !== 'asset') throw new Error('the build has no index.html');
      let html = String(page.source);
      let policy = "default-src 'none'; connect-src 'self'; img-src data: blob:; base-uri 'none'; form-action 'none'";
      for (const [name, file] of Object.entries(bundle)) {
        if (file.type === 'chunk') {
          const code = file.code.replaceAll('</script', '<\\/script').replaceAll('<!--', '<\\!--');
          html = html
            .replace(/\s*<script type="module"[^>]*><\/script>/, '')
            .replace(/\s*<link rel="modulepreload"[^>]*>/g, '');
          html = html.replace('</body>', () => `<script type="module">${code}</script>\n  </body>`);
          policy += `; script-src '${hash(code)}'`;
          delete bundle[name];
        } else if (name.endsWith('.css')) {
          const style = String(file.source);
          html = html
            .replace(/\s*<link rel="stylesheet"[^>]*>/, '')
            .replace('</head>', () => `<style>${style}</style>\n  </head>`);
          policy += `; style-src '${hash(style)}'`;
          delete bundle[name];
        }
      }
      html = html.replace(
        '<title>',
        () => `<meta http-equiv="Content-Security-Policy" content="${policy}" />\n    <title>`,
      );
      delete bundle['index.html'];
      this.emitFile({ type: 'asset', fileName: 'linewright-view.html', source: html });
    },
  };
}

function hash(text: string): string {
  return `sha256-${createHash('sha256').update(text).digest('base64')}`;
}

export default defineConfig({
  base: './',
  build: {
    outDir: '../build/web',
    emptyOutDir: false,
    modulePreload: false,
    cssCodeSplit: false,
    assetsInlineLimit: 1e6,
    target: 'es2022',
    chunkSizeWarningLimit: 2000,
    rollupOptions: { output: { inlineDynamicImports: true } },
  },
  plugins: [oneFile()],
});
