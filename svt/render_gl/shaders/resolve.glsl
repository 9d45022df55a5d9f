// Resolves samples to pixels: border lines, background, sRGB.
uniform usampler2D colorSamples, hitSamples;
uniform int side, margin, lineReach, cutReach;  // samples
uniform ivec2 pictureFirst;   // pixel of the picture at the target's lower left corner; y downwards
uniform ivec2 tileFirst;      // pixel of the picture at the first sample after the margin
uniform float pictureHeight;  // pixels
uniform vec3 backgroundTop, backgroundBottom, lineColor;  // linear light
uniform float backgroundAlpha, lineStrength;
uniform vec3 cameraRight, cameraUp, cameraForward;
uniform float samplePerDepth, sampleSize;  // distance of samples, metres: per metre of depth, and constant
uniform float voxelSize;

out vec4 pixel;  // sRGB, not premultiplied

struct Seen {
    uint object;
    float depth;
    vec3 normal;
    bool isCap, isLens;
};

Seen seenAt(ivec2 at) {
    uvec4 hit = texelFetch(hitSamples, at, 0);
    return Seen(hit.y, uintBitsToFloat(hit.z), unpackedDirection(hit.w), (hit.w & kCap) != 0u, (hit.w & kLens) != 0u);
}

#if BORDERS
bool isRim(Seen a, Seen b) { return a.isLens && !b.isLens; }

bool isCutLine(Seen a, Seen b) {
    if (a.isLens != b.isLens) return isRim(a, b);
    return a.isCap && (b.depth >= kFar || !b.isCap || a.object != b.object);
}

int reachBetween(Seen a, Seen b) {
    if (!isCutLine(a, b)) return lineReach;
    return isRim(a, b) || (b.depth < kFar && b.isCap) ? cutReach : max(lineReach, margin);
}

// Coverage of `a` by the line along its border with `b`, which is offset by `aside` (metres); see TileRenderer.
float lineBetween(Seen a, Seen b, vec3 aside, bool isFirst) {
    if (b.depth >= kFar || isRim(a, b)) return 1.0;
    if (isRim(b, a)) return 0.0;
    float difference = b.depth - a.depth;
    float facing = max(-dot(a.normal, cameraForward), kLeastFacing);
    float predicted = dot(a.normal, aside) / facing;
    float facingOther = max(-dot(b.normal, cameraForward), kLeastFacing);
    float grazing = a.object == b.object ? min(facing, facingOther) : facing;
    float tolerance = (1.0 + 2.0 / grazing) * voxelSize + length(aside) + kDepthTolerance * abs(predicted);
    bool isJump = abs(difference - predicted) > tolerance;
    bool isOther = a.object != b.object || a.isCap != b.isCap;
    if (!isJump && !isOther) return 0.0;
    if (isJump) return difference > 0.0 ? 1.0 : 0.0;
    return side > 1 || isFirst ? 1.0 : 0.0;
}

float lineOn(ivec2 at) {
    Seen a = seenAt(at);
    if (a.depth >= kFar) return 0.0;
    float size = samplePerDepth * a.depth + sampleSize;
    int most = a.isCap || a.isLens ? margin : lineReach;
    float line = 0.0;
    for (int reach = 1; reach <= kMaxReach; ++reach) {
        if (reach > most || line >= 1.0) break;
        for (int n = 0; n < 4; ++n) {
            ivec2 way = n == 0 ? ivec2(1, 0) : n == 1 ? ivec2(-1, 0) : n == 2 ? ivec2(0, -1) : ivec2(0, 1);
            Seen b = seenAt(at + way * reach);
            if (most > 1 && reach > reachBetween(a, b)) continue;
            vec3 aside = (cameraRight * float(way.x) - cameraUp * float(way.y)) * (size * float(reach));
            line = max(line, lineBetween(a, b, aside, n == 0 || n == 3 || most > 1));
        }
    }
    return line;
}
#endif

vec3 srgbOf(vec3 linear) {
    vec3 c = clamp(linear, 0.0, 1.0);
    return mix(1.055 * pow(max(c, vec3(1e-6)), vec3(1.0 / 2.4)) - 0.055, c * 12.92, lessThanEqual(c, vec3(0.0031308)));
}

void main() {
    ivec2 place = pictureFirst + ivec2(int(gl_FragCoord.x), -int(gl_FragCoord.y));
    vec3 color = vec3(0.0);
    float alpha = 0.0;
    for (int n = 0; n < kMaxSide * kMaxSide; ++n) {
        if (n >= side * side) break;
        ivec2 at = (place - tileFirst) * side + ivec2(n % side, n / side) + margin;
        vec4 light = uintBitsToFloat(texelFetch(colorSamples, at, 0));
        if (light.a <= 0.0) continue;
        float line = 0.0;
#if BORDERS
        line = lineStrength * lineOn(at);
#endif
        // A line is visible, however transparent the sample.
        float covered = light.a + (1.0 - light.a) * line * kGlassLine;
        color += min(light.rgb, 1.0) * (1.0 - line) + lineColor * (line * covered);
        alpha += covered;
    }
    float share = 1.0 / float(side * side), down = (float(place.y) + 0.5) / pictureHeight;
    color *= share;
    alpha *= share;
    float rest = (1.0 - alpha) * backgroundAlpha;
    color += mix(backgroundTop, backgroundBottom, down) * rest;
    alpha += rest;
    pixel = alpha > 0.0 ? vec4(srgbOf(color / alpha), min(alpha, 1.0)) : vec4(0.0);
}
