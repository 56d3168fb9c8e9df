// SPDX-License-Identifier: MIT
// Dual-quaternion skinning after Kavan, Collins, Zara and O'Sullivan, "Geometric Skinning with Approximate Dual
// Quaternion Blending", 2008. The palette holds two texels a joint: real and dual part, x y z w.
uniform samplerBuffer palette;
// What makes the mesh the body of one performer, see null_pose_fit.h. Two texels a joint: scale and segment, shift.
uniform samplerBuffer fits;

// Of the character: its first texel in both, and a bit for each of its selected, solved and assumed segments.
layout(location = 5) in ivec4 character;

struct Motion {
    vec4 real;
    vec4 dual;
};

struct Body {
    vec3 position;
    // To divide normals by.
    vec3 scale;
};

// `at` is a share of the mesh's cube.
Body fitted(vec3 at, uvec4 joints, vec4 weights) {
    ivec4 first = character.x + 2 * ivec4(joints);
    vec3 scale = weights.x * texelFetch(fits, first.x).xyz + weights.y * texelFetch(fits, first.y).xyz +
                 weights.z * texelFetch(fits, first.z).xyz + weights.w * texelFetch(fits, first.w).xyz;
    vec3 shift = weights.x * texelFetch(fits, first.x + 1).xyz + weights.y * texelFetch(fits, first.y + 1).xyz +
                 weights.z * texelFetch(fits, first.z + 1).xyz + weights.w * texelFetch(fits, first.w + 1).xyz;
    return Body(scale * at + shift, scale);
}

// A vertex belongs to the segments whose bits are set by so much.
float shareOf(int segments, uvec4 joints, vec4 weights) {
    ivec4 first = character.x + 2 * ivec4(joints);
    ivec4 of = ivec4(texelFetch(fits, first.x).w, texelFetch(fits, first.y).w, texelFetch(fits, first.z).w,
                     texelFetch(fits, first.w).w);
    return dot(weights, vec4((ivec4(segments) >> of) & 1));
}

Motion blendMotion(uvec4 joints, vec4 weights) {
    ivec4 at = character.x + 2 * ivec4(joints);
    vec4 pivot = texelFetch(palette, at.x);
    vec4 second = texelFetch(palette, at.y);
    vec4 third = texelFetch(palette, at.z);
    vec4 fourth = texelFetch(palette, at.w);
    // q and -q turn alike: all have to lie on the side of the joint with the largest weight, which is the first.
    vec3 side = vec3(dot(pivot, second) < 0.0 ? -1.0 : 1.0, dot(pivot, third) < 0.0 ? -1.0 : 1.0,
                     dot(pivot, fourth) < 0.0 ? -1.0 : 1.0);
    weights.yzw *= side;
    Motion motion;
    motion.real = weights.x * pivot + weights.y * second + weights.z * third + weights.w * fourth;
    motion.dual = weights.x * texelFetch(palette, at.x + 1) + weights.y * texelFetch(palette, at.y + 1) +
                  weights.z * texelFetch(palette, at.z + 1) + weights.w * texelFetch(palette, at.w + 1);
    float scale = inversesqrt(dot(motion.real, motion.real));
    motion.real *= scale;
    motion.dual *= scale;
    return motion;
}

vec3 rotate(Motion motion, vec3 v) {
    return v + 2.0 * cross(motion.real.xyz, cross(motion.real.xyz, v) + motion.real.w * v);
}

vec3 transform(Motion motion, vec3 point) {
    vec3 shift = motion.real.w * motion.dual.xyz - motion.dual.w * motion.real.xyz +
                 cross(motion.real.xyz, motion.dual.xyz);
    return rotate(motion, point) + 2.0 * shift;
}
