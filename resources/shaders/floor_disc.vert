// SPDX-License-Identifier: MIT
// The floor without its grid: rings about its centre, one an instance, that fade towards the last.
out vec4 paint;

const float kTau = 6.2831853;
const float kSectors = 48.0;
const float kFadingRings = 8.0;

float radiusOf(float ring) {
    return ring < 0.5 ? 0.0 : mix(floorFade.z, floorFade.w, (ring - 1.0) / kFadingRings);
}

void main() {
    float radius = radiusOf(float(gl_InstanceID + (gl_VertexID & 1)));
    float angle = float(gl_VertexID >> 1) * kTau / kSectors;
    vec2 at = floorFade.xy + radius * vec2(cos(angle), sin(angle));
    paint = vec4(floorColour.rgb, floorStrength(at));
    gl_Position = viewProjection * vec4(at, 0.0, 1.0);
}
