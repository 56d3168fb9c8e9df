// SPDX-License-Identifier: MIT
// The body's hull, a constant width on the screen larger than the body.
layout(location = 0) in vec4 positionAndOcclusion;
layout(location = 1) in vec3 normal;
layout(location = 2) in uvec4 joints;
layout(location = 3) in vec4 weights;

// A bit for each segment to be outlined.
uniform int outlinedSegments;
// Logical pixels.
uniform float width;

out float share;

void main() {
    Motion motion = blendMotion(joints, weights);
    Body body = fitted(positionAndOcclusion.xyz, joints, weights);
    vec3 world = transform(motion, body.position);
    share = shareOf(outlinedSegments, joints, weights);
    vec4 clip = viewProjection * vec4(world, 1.0);
    vec4 ahead = viewProjection * vec4(world + 0.01 * rotate(motion, normalize(normal / body.scale)), 1.0);
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
