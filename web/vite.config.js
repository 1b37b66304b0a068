import { svelte } from '@sveltejs/vite-plugin-svelte';
import { defineConfig } from 'vite';

// One file: the styles and the script stand in the page itself.
const inline = {
  name: 'inline',
  enforce: 'post',
  generateBundle(_, bundle) {
    const page = bundle['index.html'];
    for (const [name, file] of Object.entries(bundle)) {
      if (file === page) continue;
      const script = file.type === 'chunk';
      const text = script ? file.code : file.source;
      if (/<\/(script|style)/i.test(text)) throw new Error(`${name} would end its element`);
      const tag = new RegExp(`\\s*<(?:script|link)[^>]*${name.replaceAll('.', '\\.')}[^>]*>(</script>)?`);
      page.source = page.source.replace(tag, '');
      page.source = page.source.replace(script ? '</body>' : '</head>', () =>
        script ? `<script type="module">${text}</script>\n</body>` : `<style>${text}</style>\n</head>`);
      delete bundle[name];
    }
  },
};

export default defineConfig({
  plugins: [svelte(), inline],
  build: { modulePreload: false, assetsInlineLimit: 1e6, reportCompressedSize: false },
  server: { proxy: { '/v1': 'http://127.0.0.1:8080' } },
});
