// Arrays stored as rows of a texture, read one element at a time. Constants that C++ shares are declared before this
// source, see shared_constants.hpp.
uvec4 elementOf(usampler2D table, uint number) {
    return texelFetch(table, ivec2(int(number & uint((1 << ROW_BITS) - 1)), int(number >> ROW_BITS)), 0);
}
vec4 floatsOf(usampler2D table, uint number) { return uintBitsToFloat(elementOf(table, number)); }

// Directions in one word: octahedral encoding, 15 bits per coordinate. Bits 30 and 31 are free for flags.
const uint kCap = 0x40000000u, kLens = 0x80000000u;

uint packedDirection(vec3 direction) {
    vec3 d = direction / (abs(direction.x) + abs(direction.y) + abs(direction.z));
    vec2 side = vec2(d.x >= 0.0 ? 1.0 : -1.0, d.y >= 0.0 ? 1.0 : -1.0);
    vec2 place = d.z >= 0.0 ? d.xy : (1.0 - abs(d.yx)) * side;
    uvec2 bits = uvec2(clamp(place * 0.5 + 0.5, 0.0, 1.0) * 32767.0 + 0.5);
    return bits.x | (bits.y << 15);
}
vec3 unpackedDirection(uint bits) {
    vec2 place = vec2(bits & 32767u, (bits >> 15) & 32767u) / 32767.0 * 2.0 - 1.0;
    vec3 d = vec3(place, 1.0 - abs(place.x) - abs(place.y));
    vec2 side = vec2(d.x >= 0.0 ? 1.0 : -1.0, d.y >= 0.0 ? 1.0 : -1.0);
    if (d.z < 0.0) d.xy = (1.0 - abs(d.yx)) * side;
    return normalize(d);
}
