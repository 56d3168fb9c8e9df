// SPDX-License-Identifier: MIT
// The suit is painted by where a point sits on the mannequin in its reference null pose (metres, Z-up, X forward),
// so that seams are sharp whatever the mesh: pale head and hands, dark shoes with a pale sole, seams at the joints.
const float kShoulderHeight = 1.4196;
const vec3 kPale = vec3(0.80, 0.80, 0.81);
const vec3 kShoe = vec3(0.17, 0.18, 0.20);
const vec3 kSole = vec3(0.74, 0.75, 0.76);
const vec3 kSeam = vec3(0.13, 0.14, 0.16);

struct Paint {
    vec3 colour;
    float gloss;
};

// Covers what is inside (distance > 0) with an edge one pixel soft.
void cover(inout Paint paint, float inside, vec3 colour, float gloss, float pixel) {
    float amount = smoothstep(-pixel, pixel, inside);
    paint.colour = mix(paint.colour, colour, amount);
    paint.gloss = mix(paint.gloss, gloss, amount);
}

Paint paintSuit(vec3 at, vec3 suitColour, float metresPerPixel) {
    float side = abs(at.y);
    bool isArm = side > 0.13 && at.z > 1.2;
    float pixel = max(0.0007, 0.7 * metresPerPixel);

    Paint paint = Paint(suitColour * 0.86 + 0.10, 1.0);
    bool isTinted = (isArm && side > 0.450) || (side < 0.2 && at.z > 1.0275 && at.z < 1.2394) ||
                    (side < 0.3 && at.z < 0.499);
    paint.colour = min(paint.colour * (isTinted ? 1.10 : 1.0), vec3(1.0));

    float neckline = min((1.0 - length(vec2((at.x - 0.004) / 0.078, at.y / 0.081))) * 0.08,
                         at.z - (1.466 - 0.62 * max(at.x + 0.01, 0.0)));
    neckline = at.z > 1.516 ? 0.05 : neckline;
    float wrist = isArm ? side - 0.668 : -1.0;
    float ankle = side < 0.3 ? 0.105 - at.z - 0.25 * min(at.x, 0.05) : -1.0;
    cover(paint, side < 0.14 ? neckline : -1.0, kPale, 0.55, pixel);
    cover(paint, wrist, kPale, 0.55, pixel);
    cover(paint, ankle, kShoe, 1.25, pixel);
    cover(paint, side < 0.3 ? 0.011 - at.z : -1.0, kSole, 0.3, pixel);

    // The nearest of all seams is enough: they never cross.
    float seam = 9.0;
    seam = min(seam, side < 0.12 && at.z < 1.512 ? abs(neckline) : 9.0);
    seam = min(seam, isArm ? min(abs(side - 0.668), abs(side - 0.450)) : 9.0);
    seam = min(seam, at.z < 0.7 ? min(abs(at.z - 0.499), abs(ankle)) : 9.0);
    seam = min(seam, at.z > 1.2 && at.z < 1.55 && side > 0.08
                         ? abs((side - 0.172) * 0.95 + (at.z - kShoulderHeight) * 0.31) : 9.0);
    seam = min(seam, side < 0.2 && at.z > 0.95 && at.z < 1.2 ? abs(at.z - 1.0275) : 9.0);
    seam = min(seam, side < 0.175 && at.z > 1.1 && at.z < 1.35 ? abs(at.z - 1.2394) : 9.0);
    // Narrower than a pixel it gets fainter instead of breaking up.
    const float kHalfWidth = 0.0019;
    float strength = 0.8 * min(1.0, 2.0 * kHalfWidth / max(metresPerPixel, 1e-5));
    float line = 1.0 - smoothstep(kHalfWidth - 0.6 * pixel, kHalfWidth + 0.8 * pixel, seam);
    paint.colour = mix(paint.colour, kSeam, strength * line);
    paint.gloss *= 1.0 - 0.7 * line;
    return paint;
}
