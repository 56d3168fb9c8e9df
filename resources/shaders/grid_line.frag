// SPDX-License-Identifier: MIT
uniform float lineWidth;

in vec4 paint;
noperspective in float across;

out vec4 fragment;

void main() {
    fragment = vec4(paint.rgb, paint.a * clamp(0.5 * lineWidth + 0.5 - abs(across), 0.0, 1.0));
}
