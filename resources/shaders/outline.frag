// SPDX-License-Identifier: MIT
in float share;

uniform vec3 colour;

out vec4 fragment;

void main() {
    if (share < 0.5) {
        discard;
    }
    fragment = vec4(colour, 1.0);
}
