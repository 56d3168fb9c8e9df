// SPDX-License-Identifier: MIT
layout(location = 0) in vec4 positionAndOcclusion;
layout(location = 2) in uvec4 joints;
layout(location = 3) in vec4 weights;

void main() {
    Motion motion = blendMotion(joints, weights);
    Body body = fitted(positionAndOcclusion.xyz, joints, weights);
    gl_Position = lightViewProjection * vec4(transform(motion, body.position), 1.0);
}
