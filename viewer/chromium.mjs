// SPDX-License-Identifier: Apache-2.0
// The browser that pictures and measurements are made with: Chromium, which draws by software.
import { existsSync } from 'node:fs';
import { chromium } from 'playwright-core';

export function launchChromium() {
  const executablePath = [process.env.SKEIN_CHROMIUM, '/usr/bin/chromium', '/usr/bin/google-chrome']
    .find((path) => path && existsSync(path));
  return chromium.launch({
    executablePath,
    args: ['--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader',
      '--disable-accelerated-2d-canvas', '--disable-gpu-rasterization'],
  });
}
