// SPDX-License-Identifier: MIT
// The body's hull, a constant width on the screen larger than the body.
layout(location = 0) in vec4 positionAndOcclusion;
layout(location = 1) in vec3 normal;
layout(location = 3) in uvec4 joints;
layout(location = 4) in vec4 weights;
// Those of the joints.
layout(location = 5) in uvec4 segments;

// A bit for each segment to be outlined.
uniform int outlinedSegments;
// Logical pixels.
uniform float width;

out float share;

float shareOf(uint segment, float weight) {
    return weight * float((outlinedSegments >> int(segment)) & 1);
}

void main() {
    Motion motion = blendMotion(joints, weights);
    vec3 world = transform(motion, positionAndOcclusion.xyz);
    share = shareOf(segments.x, weights.x) + shareOf(segments.y, weights.y) + shareOf(segments.z, weights.z) +
            shareOf(segments.w, weights.w);
    vec4 clip = viewProjection * vec4(world, 1.0);
    vec4 ahead = viewProjection * vec4(world + 0.01 * rotate(motion, normal), 1.0);
    vec2 aside = (ahead.xy * clip.w - clip.xy * ahead.w) * viewport.xy;
    float size = length(aside);
    // Behind the eye a direction on the screen means nothing.
    if (size > 1e-9 && clip.w > 0.01 && ahead.w > 0.01) {
        clip.xy += aside / size * 2.0 * width * style.x * viewport.zw * clip.w;
    }
    // The wider hull is the farther one: what is within it is drawn over it.
    vec4 back = viewProjection * vec4(world - 0.01 * width * towardsEye(world), 1.0);
    clip.z = back.z / max(back.w, 1e-4) * clip.w;
    // As the body's own, see skinned.vert.
    gl_ClipDistance[0] = world.z;
    gl_Position = clip;
}
