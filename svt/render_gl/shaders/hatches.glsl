// Hatches of caps (cut faces), as by render::hatchCoverage(). Lengths in metres.
uniform vec3 originFromMiddle;  // the grid's origin, position as in ray.glsl
uniform vec3 gridNorth, gridUp;
uniform mat3 worldFromIndex;  // of directions
uniform vec3 hatchColor;      // linear light
uniform float hatchSpacing, hatchWidth, hatchStrength;  // metres, pixels, 0..1
uniform float pixelPerDepth, pixelSize;                 // size of a pixel, metres: per metre of depth, and constant
uniform float samplesAlong;                             // samples along a pixel
uniform vec3 cameraForward;

const float kRoot2 = 1.41421356;

float spacing, lineWidth, blur;

float lineInk(float apart) {
    return clamp((lineWidth * 0.5 + blur * 0.5 - apart) / blur, 0.0, 1.0) * min(1.0, lineWidth / blur);
}
float stripes(float x, float period) { return lineInk(abs(x - period * round(x / period))); }

// Product of 64-bit integers; low word first.
uvec2 times(uvec2 a, uvec2 b) {
    uvec2 a0 = uvec2(a.x & 0xFFFFu, a.x >> 16), b0 = uvec2(b.x & 0xFFFFu, b.x >> 16);
    uint bottom = a0.x * b0.x, cross1 = a0.y * b0.x, cross2 = a0.x * b0.y;
    uint carry = (bottom >> 16) + (cross1 & 0xFFFFu) + (cross2 & 0xFFFFu);
    uint top = a0.y * b0.y + (cross1 >> 16) + (cross2 >> 16) + (carry >> 16);
    return uvec2((bottom & 0xFFFFu) | (carry << 16), top + a.x * b.y + a.y * b.x);
}
uvec2 shifted(uvec2 v, uint by) { return uvec2((v.x >> by) | (v.y << (32u - by)), v.y >> by); }
uvec2 wide(float whole) {
    int i = int(whole);
    return uvec2(uint(i), i < 0 ? 0xFFFFFFFFu : 0u);
}
// A pseudo-random number, 0..1, by cell.
float randomOf(float i, float j, uint salt) {
    uvec2 hash = times(wide(i), uvec2(0x7F4A7C15u, 0x9E3779B9u)) ^ times(wide(j), uvec2(0x27D4EB4Fu, 0xC2B2AE3Du)) ^
                 times(uvec2(salt, 0u), uvec2(0x9E3779F9u, 0x165667B1u));
    hash = times(hash ^ shifted(hash, 31u), uvec2(0x1CE4E5B9u, 0xBF58476Du));
    hash = times(hash ^ shifted(hash, 29u), uvec2(0x133111EBu, 0x94D049BBu));
    return float(hash.y >> 8) / 16777216.0;
}

float toSegment(vec2 p, vec2 a, vec2 b) {
    vec2 way = b - a;
    return length(p - a - way * clamp(dot(p - a, way) / dot(way, way), 0.0, 1.0));
}

// A dot in each square field, and a triangle in some.
float gravel(vec2 p) {
    vec2 field = floor(p / spacing), place = p - field * spacing;
    vec2 center = (0.3 + 0.4 * vec2(randomOf(field.x, field.y, 1u), randomOf(field.x, field.y, 2u))) * spacing;
    if (randomOf(field.x, field.y, 3u) > 0.3) {
        float radius = 0.5 * lineWidth + (0.02 + 0.03 * randomOf(field.x, field.y, 4u)) * spacing;
        return clamp((radius + blur * 0.5 - length(place - center)) / blur, 0.0, 1.0);
    }
    float turn = 6.28318531 * randomOf(field.x, field.y, 5u), nearest = spacing;
    for (int n = 0; n < 3; ++n) {
        float a = turn + float(n) * 2.09439510, b = a + 2.09439510;
        nearest = min(nearest, toSegment(place, center + 0.22 * spacing * vec2(cos(a), sin(a)),
                                         center + 0.22 * spacing * vec2(cos(b), sin(b))));
    }
    return lineInk(nearest);
}

float hatchCoverage(uint hatch, vec2 p) {
    if (spacing < 2.0 * blur) return min(0.5, 0.7 * lineWidth / spacing);
    float across = (p.x - p.y) / kRoot2, along = (p.x + p.y) / kRoot2;
    if (hatch == kHatchMasonry) return stripes(across, spacing);
    if (hatch == kHatchConcrete) return gravel(p);
    if (hatch == kHatchReinforcedConcrete) {
        bool isDashed = mod(abs(round(across / spacing)), 2.0) == 1.0;
        return isDashed && fract(along / (2.4 * spacing)) > 0.65 ? 0.0 : stripes(across, spacing);
    }
    if (hatch == kHatchTimber) {
        float bend = 0.35 * spacing * sin(p.x / (2.1 * spacing) + 0.9 * sin(p.y / (3.0 * spacing)));
        return stripes(p.y + bend, 0.8 * spacing);
    }
    if (hatch == kHatchInsulation) {
        float band = 3.0 * spacing, tooth = 0.75 * spacing;
        float height = p.y - band * floor(p.y / band);
        float way = p.x / tooth - 2.0 * floor(p.x / (2.0 * tooth));
        float wave = band * (way < 1.0 ? way : 2.0 - way), slope = band / tooth;
        return max(stripes(p.y, band), lineInk(abs(height - wave) / sqrt(1.0 + slope * slope)));
    }
    if (hatch == kHatchEarth) {
        float field = 4.0 * spacing;
        vec2 number = floor(p / field), place = p - (number + 0.5) * field;
        bool isTurned = mod(abs(number.x + number.y), 2.0) == 1.0;
        float off = (isTurned ? place.x + place.y : place.x - place.y) / kRoot2;
        float way = (isTurned ? place.x - place.y : place.x + place.y) / kRoot2;
        return abs(way) > 0.42 * field || abs(off) > 1.2 * spacing ? 0.0 : stripes(off, spacing);
    }
    if (hatch == kHatchSteel)
        return max(stripes(across, 2.0 * spacing), stripes(across - 0.5 * spacing, 2.0 * spacing));
    if (hatch == kHatchGlass) {
        float at = along / (6.0 * spacing) + randomOf(round(across / (1.5 * spacing)), 0.0, 6u);
        return fract(at) < 0.3 ? stripes(across, 1.5 * spacing) : 0.0;
    }
    return hatch == kHatchGeneral ? stripes(across, 2.0 * spacing) : 0.0;
}

// Coverage by ink at the point of a cap that the ray meets at `depth`.
float inkOn(uint hatch, vec3 normal, float depth) {
    if (hatch == kHatchNone) return 0.0;
    // The vertical axis is the grid's up direction projected onto the face; on nearly horizontal faces, north.
    vec3 above = abs(dot(normal, gridUp)) < kLevelCap ? gridUp : gridNorth;
    vec3 upwards = normalize(above - normal * dot(normal, above)), aside = cross(upwards, normal);
    vec3 point = worldFromIndex * (origin + direction * (depth - middleDepth) - originFromMiddle);
    float pixel = pixelPerDepth * depth + pixelSize;
    float facing = max(abs(dot(normal, cameraForward)), kLeastCapFacing);
    spacing = hatchSpacing;
    lineWidth = hatchWidth * pixel;
    blur = pixel / (facing * samplesAlong);
    return hatchCoverage(hatch, vec2(dot(point, aside), dot(point, upwards))) * hatchStrength;
}
