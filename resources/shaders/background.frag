// SPDX-License-Identifier: MIT
out vec4 fragment;

void main() {
    fragment = vec4(backgroundAt(gl_FragCoord.xy) + dither(gl_FragCoord.xy), 1.0);
}
