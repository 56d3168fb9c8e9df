// SPDX-License-Identifier: MIT
// What all that draws the floor agrees on.

// 1 where the floor is there, 0 where it has faded into the background.
float floorStrength(vec2 at) {
    return 1.0 - smoothstep(floorFade.z, floorFade.w, distance(at, floorFade.xy));
}

// How dark the floor is for the shares of the key light and of the sky that are hidden.
float shadowDarkness(vec2 hidden) {
    return 1.0 - (1.0 - 0.82 * hidden.x) * (1.0 - 0.90 * hidden.y);
}
