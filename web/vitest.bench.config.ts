import { defineConfig } from 'vitest/config';

export default defineConfig({
  test: { include: ['benchmarks/**/*.bench.ts'], environment: 'node', fileParallelism: false, testTimeout: 300_000 },
});
