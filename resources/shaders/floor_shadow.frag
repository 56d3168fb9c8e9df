// SPDX-License-Identifier: MIT
// The shadow on the floor, softened once in the light's picture instead of for every pixel of the screen. Red: how
// much of the key light is hidden; green: how much of the sky is hidden by what nearly touches the floor.
uniform sampler2D shadowDepth;
uniform sampler2DShadow shadowMap;
uniform int capsuleCount;
// Pairs: from and radius, then to and an unused value.
uniform vec4 capsules[24];
uniform float mapSize;

out vec4 fragment;

const int kTaps = 12;
// Vogel's spiral, equal areas.
const vec2 kDisc[kTaps] = vec2[kTaps](
    vec2(0.2041, 0.0000), vec2(-0.2607, 0.2388), vec2(0.0399, -0.4547), vec2(0.3286, 0.4286),
    vec2(-0.6029, -0.1067), vec2(0.5712, -0.3633), vec2(-0.1876, 0.7116), vec2(-0.3660, -0.7012),
    vec2(0.7896, 0.2880), vec2(-0.8071, 0.3706), vec2(0.3530, -0.8660), vec2(0.3417, 0.9177));
// Half the angle of the light as its tangent: the penumbra grows by this much a metre.
const float kLightSize = 0.022;

// Whether the light meets something before the floor; nothing was drawn where the depth is 1.
float blocks(float there, float floorDepth) {
    return step(there, min(floorDepth - 0.002 / shadowRange.y, 0.99999));
}

float hiddenKey(vec3 at) {
    float search = 0.05 / shadowRange.x;
    float blockers = 0.0;
    float depth = 0.0;
    for (int i = 0; i < kTaps; ++i) {
        float there = texture(shadowDepth, at.xy + search * kDisc[i]).r;
        float isBlocker = blocks(there, at.z);
        blockers += isBlocker;
        depth += isBlocker * there;
    }
    float distance = (at.z - depth / max(blockers, 1.0)) * shadowRange.y;
    float radius = max(blockers > 0.0 ? kLightSize * distance : 0.0, 0.012) / shadowRange.x;
    // Beyond the light's picture the depth would be cut off at 1, and compared with nothing.
    float compared = min(at.z - 0.002 / shadowRange.y, 0.99999);
    float hidden = 0.0;
    for (int i = 0; i < kTaps; ++i) {
        hidden += 1.0 - texture(shadowMap, vec3(at.xy + radius * kDisc[i], compared));
    }
    return hidden / float(kTaps);
}

// Share of the hemisphere over a floor point that a ball hides: (r / d)^2 cos, at the capsule's nearest point.
float hiddenSky(vec3 point) {
    float open = 1.0;
    for (int i = 0; i < capsuleCount; ++i) {
        vec4 from = capsules[2 * i];
        vec3 axis = capsules[2 * i + 1].xyz - from.xyz;
        float along = clamp(dot(point - from.xyz, axis) / max(dot(axis, axis), 1e-8), 0.0, 1.0);
        vec3 nearest = from.xyz + along * axis - point;
        float square = max(dot(nearest, nearest), from.w * from.w);
        open *= 1.0 - clamp(from.w * from.w * max(nearest.z, 0.0) / (square * sqrt(square)), 0.0, 0.95);
    }
    return 1.0 - open;
}

void main() {
    vec2 device = 2.0 * gl_FragCoord.xy / mapSize - 1.0;
    vec3 near = (inverseLightViewProjection * vec4(device, -1.0, 1.0)).xyz;
    vec3 far = (inverseLightViewProjection * vec4(device, 1.0, 1.0)).xyz;
    float share = near.z / (near.z - far.z);
    fragment = vec4(hiddenKey(vec3(0.5 * device + 0.5, share)), hiddenSky(mix(near, far, share)), 0.0, 1.0);
}
