// SPDX-License-Identifier: MIT
// The suit is painted by where a point sits on the mannequin in its reference null pose (metres, Z-up, X forward), so
// that seams are sharp whatever the mesh. Every edge is the zero of a function that is continuous over the whole
// body: it closes around limb and trunk without an end, and its own slope on the screen says how soft it has to be.
const float kShoulderHeight = 1.4196;
const vec3 kPale = vec3(0.83, 0.835, 0.845);
const vec3 kGraphite = vec3(0.205, 0.215, 0.235);
const vec3 kShoe = vec3(0.42, 0.43, 0.45);
const vec3 kBlack = vec3(0.045, 0.05, 0.06);
const vec3 kSeam = vec3(0.10, 0.11, 0.13);

struct Paint {
    vec3 colour;
    float gloss;
    // How much of the surroundings it reflects.
    float mirror;
};

// Covers what is inside (distance > 0) with an edge one pixel soft.
void cover(inout Paint paint, float inside, vec3 colour, float gloss, float mirror) {
    float pixel = 0.75 * fwidth(inside) + 1e-6;
    float amount = smoothstep(-pixel, pixel, inside);
    paint.colour = mix(paint.colour, colour, amount);
    paint.gloss = mix(paint.gloss, gloss, amount);
    paint.mirror = mix(paint.mirror, mirror, amount);
}

// Distance into the visor: wide at the eyes, narrow at the chin, with round corners.
float visorAt(vec3 at, float forwards) {
    float aside = 1.0 - forwards;
    float above = at.z - 1.5785 - 0.050 * aside;
    float below = 1.7035 - 0.022 * aside - at.z;
    float within = 0.105 * (forwards - 0.46);
    vec3 edge = max(0.026 - vec3(above, below, within), 0.0);
    return min(0.026 - length(edge), min(above, min(below, within)) + 0.012);
}

// How the flanks run from the wrists along the arms and the trunk to the ankles.
float flankAt(vec3 at, float side) {
    float width = 0.017 + 0.021 * smoothstep(0.10, 0.80, at.z) - 0.012 * smoothstep(0.98, 1.14, at.z) +
                  0.016 * smoothstep(1.14, 1.33, at.z) - 0.026 * smoothstep(0.17, 0.42, side);
    return min(min(width - abs(at.x), side - 0.090), 1.395 - at.z);
}

// An oval on the front of a limb, pads of knees and elbows.
float padAt(vec2 offset, vec2 size, float front) {
    return min((1.0 - length(offset / size)) * size.x, front);
}

Paint paintSuit(vec3 at, vec3 suitColour, float metresPerPixel) {
    float side = abs(at.y);
    vec3 cloth = suitColour * 0.86 + 0.10;
    float bright = smoothstep(0.16, 0.30, dot(cloth, vec3(0.30, 0.59, 0.11)));
    vec3 deep = cloth * mix(2.1, 0.60, bright);
    Paint paint = Paint(cloth, 1.0, 0.0);

    // The head turns about this axis of the helmet: 1 is ahead, −1 behind.
    float forwards = (at.x + 0.012) / max(length(vec2(at.x + 0.012, at.y)), 1e-4);
    float collarFoot = 0.08 * (1.0 - length(vec2((at.x + 0.006) / 0.077, at.y / 0.082)));
    collarFoot = 0.03 - length(max(0.03 - vec2(collarFoot, at.z - 1.458 + 0.38 * at.x), 0.0));
    collarFoot = max(collarFoot, at.z - 1.530);
    float collarTop = at.z - 1.5225;
    float helmet = at.z - 1.580 + 0.40 * at.x;
    float wrist = side - 0.668;
    float ankle = 0.105 - at.z - 0.25 * min(at.x, 0.05);
    float midsole = 0.0262 - 0.025 * at.x - at.z;
    float flank = min(flankAt(at, side), min(-wrist, -ankle));
    float knee = padAt(vec2(side - 0.084, at.z - 0.508), vec2(0.037, 0.062), at.x);
    float elbow = padAt(vec2(at.z - kShoulderHeight, side - 0.452), vec2(0.027, 0.048), -at.x);
    float strap = min(0.0065 - abs(at.z - 1.652 - 0.02 * forwards), 0.08 * (0.40 - forwards));

    cover(paint, max(max(flank, collarFoot), max(knee, elbow)), deep, 0.8, 0.0);
    // The heels keep the colour of the suit.
    float shoe = min(ankle, at.x + 0.024 + 0.30 * (at.z - 0.02));
    cover(paint, max(collarTop, shoe), at.z < 0.5 ? kShoe : kGraphite, 0.9, 0.0);
    cover(paint, max(max(helmet, wrist), midsole), kPale, 0.6, 0.0);
    cover(paint, max(max(visorAt(at, forwards), strap), 0.0085 - at.z), kBlack, 1.6, 1.0);

    // The nearest of all seams is enough.
    float chest = at.z - 1.226 - 1.2 * at.y * at.y;
    float zip = max(max(side, at.z - 1.5225), max(-chest, -0.5 * at.x));
    float seam = min(min(abs(collarFoot), abs(collarTop)), min(abs(wrist), min(abs(ankle), max(abs(shoe), midsole))));
    seam = min(seam, max(min(abs(side - 0.450), abs(at.z - 0.499 + 0.10 * at.x)), max(knee, elbow)));
    seam = min(seam, min(abs((side - 0.172) * 0.95 + (at.z - kShoulderHeight) * 0.31),
                         abs(at.z - 1.0275 + 0.14 * at.x)));
    seam = min(seam, min(abs(chest), min(abs(flank), zip)));
    seam = min(seam, abs(helmet));
    // Narrower than a pixel it gets fainter instead of breaking up.
    const float kHalfWidth = 0.0016;
    float pixel = fwidth(seam) + 1e-6;
    float strength = 0.8 * min(1.0, 2.0 * kHalfWidth / max(metresPerPixel, 1e-5));
    float line = 1.0 - smoothstep(kHalfWidth - 0.5 * pixel, kHalfWidth + 0.7 * pixel, seam);
    paint.colour = mix(paint.colour, mix(vec3(0.42), kSeam, bright), strength * line);
    paint.gloss *= 1.0 - 0.7 * line;
    return paint;
}
