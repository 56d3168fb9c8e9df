// SPDX-License-Identifier: MIT
in vec3 worldPosition;
in vec3 worldNormal;
in vec3 suitPosition;
in float occlusion;
#ifdef MARKS_SEGMENTS
in vec3 shares;
#endif
#ifdef OWN_CHARACTER
in vec2 texturePlace;

uniform sampler2D partTexture;
uniform vec3 partColour;
uniform float hasTexture;
// Below this alpha a texel is a hole.
uniform float leastAlpha;
#endif

flat in vec3 colour;
flat in float dim;
flat in float opacity;
flat in float hatched;

uniform sampler2DShadow shadowMap;
uniform float hasSuit;

out vec4 fragment;

const vec3 kPlainCloth = vec3(0.70, 0.71, 0.72);
const vec3 kCoolCloth = vec3(0.60, 0.695, 0.79);
const float kFinestHatch = 0.015;

// The light's picture through a tent three or five texels wide, in bilinear comparisons whose places and weights move
// with the point, so that the soft edge has no steps: after Ignacio Castaño, "Shadow Mapping Summary", 2013.
float softly(vec3 at) {
    vec2 texels = at.xy / shadowRange.z;
    vec2 base = floor(texels + 0.5);
    vec2 part = texels + 0.5 - base;
#ifdef WIDE_SELF_SHADOW
    const int kTaps = 3;
    vec2 weights[kTaps] = vec2[kTaps](4.0 - 3.0 * part, vec2(7.0), 1.0 + 3.0 * part);
    vec2 places[kTaps] = vec2[kTaps]((3.0 - 2.0 * part) / weights[0] - 2.5, (3.0 + part) / weights[1] - 0.5,
                                     part / weights[2] + 1.5);
    const float kSum = 144.0;
#else
    const int kTaps = 2;
    vec2 weights[kTaps] = vec2[kTaps](3.0 - 2.0 * part, 1.0 + 2.0 * part);
    vec2 places[kTaps] = vec2[kTaps]((2.0 - part) / weights[0] - 1.5, part / weights[1] + 0.5);
    const float kSum = 16.0;
#endif
    float sum = 0.0;
    for (int row = 0; row < kTaps; ++row) {
        for (int column = 0; column < kTaps; ++column) {
            vec2 place = (base + vec2(places[column].x, places[row].y)) * shadowRange.z;
            sum += weights[column].x * weights[row].y * textureLod(shadowMap, vec3(place, at.z), 0.0);
        }
    }
    return sum / kSum;
}

// 1 in the light. Where the light only grazes the surface, a texel of its picture covers much of it: there the point is
// looked up farther outside.
float lit(vec3 position, vec3 normal, float facing) {
    if (facing <= 0.0) {
        return 0.0;
    }
    float outside = 0.012 + 0.022 * (1.0 - facing);
    vec4 inLight = lightViewProjection * vec4(position + outside * normal, 1.0);
    vec3 at = 0.5 * inLight.xyz + 0.5;
    at.z -= 0.004 / shadowRange.y;
#ifdef HARD_SELF_SHADOW
    return mix(1.0, texture(shadowMap, at), shadowRange.w);
#else
    return mix(1.0, softly(at), shadowRange.w);
#endif
}

vec3 shade(Paint paint, vec3 normal, vec3 view, float open) {
    float facing = dot(normal, light.xyz);
    float visible = lit(worldPosition, normal, facing);
    float hemisphere = 0.5 * normal.z + 0.5;
    float key = max(facing, 0.0) * visible;
    float fillLight = max(dot(normal, fill.xyz), 0.0);
    vec3 ambient = mix(vec3(0.23, 0.23, 0.24), vec3(0.50, 0.51, 0.53), hemisphere);
    vec3 result = paint.colour * (open * (ambient + 0.09 * fillLight) + vec3(0.71, 0.70, 0.68) * key);

    vec3 middle = normalize(light.xyz + view);
    float shine = max(dot(normal, middle), 0.0);
    float shine2 = shine * shine;
    float shine4 = shine2 * shine2;
    float shine8 = shine4 * shine4;
    float sharp = shine8 * shine8 * shine8 * shine8 * shine8;
    float grazing = 1.0 - max(dot(normal, view), 0.0);
    float rim = grazing * grazing * grazing;
    // Glass shows a bright sky above a dark horizon, more of it where one looks along it.
    float up = 2.0 * dot(normal, view) * normal.z - view.z;
    float sky = 0.10 + 0.55 * smoothstep(0.05, 0.75, up);
    result += paint.mirror * sky * (0.20 + 0.80 * rim);
    result += paint.gloss * visible * step(0.0, facing) * (0.13 * sharp + 0.045 * shine8);
    result += 0.11 * rim * open * (0.35 + 0.65 * hemisphere);
    // Lifts the middle as a power of 1 / 1.15 does, at a third of its cost.
    result = clamp(result, 0.0, 1.0);
    return result * (1.22 - 0.22 * result);
}

#ifdef MARKS_SEGMENTS
// Where a point lies along diagonal stripes that are fixed to the body at rest and run around limbs and trunk like a
// thread, on the trunk on each side of its middle; metres. The threads close since the way around is a whole number of
// their periods, at any power of two.
// y: how much closer than they should the threads come, where the limb is thin.
vec2 alongThread(vec3 at) {
    bool isArm = abs(at.y) > 0.15 && at.z > 1.2;
    if (hasSuit < 0.5 || (isArm && abs(at.y) > 0.68)) {
        return vec2(dot(at, vec3(0.62, 0.56, 0.55)), 1.0);
    }
    bool isFoot = at.z < 0.09;
    bool isLeg = at.z < 0.86;
    vec2 across = vec2(isFoot ? at.z : at.x, isArm ? at.z - 1.4196 : abs(at.y) - (isLeg ? 0.084 : 0.0));
    float threads = isArm || isLeg ? 24.0 : at.z > 1.50 ? 40.0 : 64.0;
    float turns = threads * kFinestHatch / 6.28318531;
    float along = isArm ? abs(at.y) : isFoot ? at.x : at.z;
    return vec2(along + turns * atan(across.y, across.x), length(vec2(1.0, turns / max(length(across), 1e-4)))) * 0.75;
}

float stripes(float place, float period, float metresPerPixel) {
    float away = abs(fract(place / period) - 0.5) * period;
    return smoothstep(-metresPerPixel, metresPerPixel, away - 0.31 * period);
}

// Fine stripes at every distance: where they would come closer than a few pixels, every second one fades out.
float hatching(vec3 at, float metresPerPixel) {
    vec2 thread = alongThread(at);
    float pixel = metresPerPixel * thread.y;
    float octave = clamp(log2(6.5 * pixel / kFinestHatch), 0.0, 4.0);
    float period = kFinestHatch * 0.75 * exp2(floor(octave));
    return mix(stripes(thread.x, period, 0.7 * pixel), stripes(thread.x, 2.0 * period, 0.7 * pixel),
               smoothstep(0.5, 1.0, fract(octave)));
}

// What was solved is plain cloth with half of the suit's colour, without gloss; what is assumed is hatched in it. The
// visor stays, and a trace of the pattern, so that one sees where a body faces.
void showProvenance(inout Paint paint, vec2 solvedAndAssumed, float metresPerPixel) {
    float solved = solvedAndAssumed.x;
    float assumed = solvedAndAssumed.y;
    // Orange and red would fade to the colour of skin: they fade less, and to cooler cloth.
    float warmth = clamp(2.5 * (colour.r - colour.b), 0.0, 1.0);
    vec3 plain = mix(colour * 0.86 + 0.10, mix(kPlainCloth, kCoolCloth, warmth), 0.46 - 0.22 * warmth);
    float cloth = 1.0 - 0.8 * paint.mirror;
    paint.colour = mix(paint.colour, plain, 0.74 * solved * cloth);
    float plainness = max(solved, assumed);
    paint.gloss *= 1.0 - 0.9 * plainness * cloth;
    paint.mirror *= 1.0 - 0.6 * plainness;
    vec3 hatched = mix(kPlainCloth, 0.5 * colour + 0.08, 0.9 * hatching(suitPosition, metresPerPixel));
    paint.colour = mix(paint.colour, hatched, 0.82 * assumed * cloth);
}
#endif

void main() {
    vec3 normal = normalize(worldNormal);
#ifdef OWN_CHARACTER
    // Of thin cloth the other side is seen, too.
    normal = gl_FrontFacing ? normal : -normal;
#endif
    vec3 view = towardsEye(worldPosition);
    float metresPerPixel = length(fwidth(suitPosition)) * 0.7;
    Paint paint = Paint(colour * 0.86 + 0.10, 1.0, 0.0);
#ifdef OWN_CHARACTER
    vec4 texel = mix(vec4(1.0), texture(partTexture, texturePlace), hasTexture);
    if (texel.a < leastAlpha) {
        discard;
    }
    paint = Paint(partColour * texel.rgb, 0.35, 0.0);
#else
    if (hasSuit > 0.5) {
        paint = paintSuit(suitPosition, colour, metresPerPixel);
    }
#endif
#ifdef MARKS_SEGMENTS
    showProvenance(paint, smoothstep(0.42, 0.58, shares.yz), metresPerPixel);
    float selection = shares.x;
    float selected = smoothstep(0.42, 0.58, selection);
    paint.colour = mix(paint.colour, mix(vec3(1.0), selectionColour.rgb, 0.45), 0.42 * selected);
#endif
    // The baked occlusion is of skin that touches: as it is, creases and fingers would turn black.
    vec3 result = shade(paint, normal, view, 0.35 + 0.65 * occlusion);
#ifdef MARKS_SEGMENTS
    // The outline goes on across the body where the segment ends.
    float border = abs(selection - 0.5) / max(fwidth(selection), 1e-4) / style.x;
    float near = step(0.02, selection);
    result = mix(result, selectionColour.rgb, near * (1.0 - smoothstep(2.0, 2.7, border)));
    result = mix(result, vec3(1.0), near * (1.0 - smoothstep(0.5, 1.2, border)));
#endif

    vec3 background = backgroundAt(gl_FragCoord.xy);
    float grey = dot(result, vec3(0.30, 0.59, 0.11));
    result = mix(result, mix(vec3(grey), background, 0.35), dim);
    float stripe = abs(fract((gl_FragCoord.x + gl_FragCoord.y) / (11.0 * style.x)) - 0.5) * 11.0 * style.x;
    float gap = smoothstep(2.6 * style.x - 0.7, 2.6 * style.x + 0.7, stripe);
    result = mix(result, background, 0.72 * hatched * gap);
    fragment = vec4(result + dither(gl_FragCoord.xy), opacity);
}
