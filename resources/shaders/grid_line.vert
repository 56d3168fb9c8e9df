// SPDX-License-Identifier: MIT
// The grid as lines of constant width on the screen, one an instance, first along x and then along y in turn. A line
// reaches from edge to edge of the floor's disc, in pieces, so that its fading can follow that of the floor.
uniform float spacing;     // metres
uniform float lineWidth;   // device pixels
uniform vec4 lineColour;   // a: strength
uniform int linesEachSide; // of the middle

out vec4 paint;
noperspective out float across; // pixels from the middle of the line

const float kPieces = 12.0;

void main() {
    bool isAlongX = (gl_InstanceID & 1) == 0;
    vec2 centre = isAlongX ? floorFade.xy : floorFade.yx;
    float line = (floor(centre.y / spacing) + float((gl_InstanceID >> 1) - linesEachSide)) * spacing;
    float aside = line - centre.y;
    float reachAlong = sqrt(max(floorFade.w * floorFade.w - aside * aside, 0.0));
    float along = centre.x + reachAlong * (2.0 * float(gl_VertexID >> 1) / kPieces - 1.0);
    vec2 at = isAlongX ? vec2(along, line) : vec2(line, along);
    vec3 forward = isAlongX ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0);

    // Derivatives of the place on the screen, in pixels; they hold behind the eye too, where the line is clipped.
    vec4 clip = viewProjection * vec4(at, 0.0, 1.0);
    vec4 ahead = viewProjection * vec4(forward, 0.0);
    vec4 beside = viewProjection * vec4(forward.yxz * spacing, 0.0);
    vec2 direction = (ahead.xy * clip.w - clip.xy * ahead.w) * viewport.xy;
    vec2 normal = normalize(vec2(-direction.y, direction.x) + vec2(1e-9, 0.0));
    vec2 toNext = (beside.xy * clip.w - clip.xy * beside.w) * 0.5 * viewport.xy / max(clip.w * clip.w, 1e-6);
    // Lines that come closer than a few pixels fade out, as floor.frag has it.
    float apart = clamp((abs(dot(normal, toNext)) - 4.0) * 0.1, 0.0, 1.0);

    float reach = 0.5 * lineWidth + 0.5;
    across = (gl_VertexID & 1) != 0 ? reach : -reach;
    clip.xy += normal * across * 2.0 * viewport.zw * clip.w;
    paint = vec4(lineColour.rgb, lineColour.a * apart * floorStrength(at));
    gl_Position = reachAlong > 0.0 ? clip : vec4(2.0, 2.0, 2.0, 1.0);
}
