// SPDX-License-Identifier: Apache-2.0
/// <reference types="vite/client" />
declare module '*?raw' {
  const text: string;
  export default text;
}
