import { defineConfig } from 'vitest/config';

// Tests of the built page in Chromium, one after the other: a machine that draws in software has enough to do.
export default defineConfig({
  test: {
    include: ['tests/**/*.test.ts'],
    environment: 'node',
    fileParallelism: false,
    testTimeout: 40_000,
    hookTimeout: 60_000,
  },
});
