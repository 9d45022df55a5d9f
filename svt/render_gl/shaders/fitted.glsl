// Normals fitted to voxels, as by render::fitNormal(). The window of 7 x 7 x 7 voxels is seven words of 64 bits, bit
// x + 8 y of word z; a height field over the plane across an axis has one word per height.
uniform usampler2D patterns;  // number of the palette brick of each brick; kNone: the brick has one scalar

struct Layers {
    uvec2 a, b, c, d, e, f, g;
};

uvec2 layerOf(Layers l, int n) {
    return n < 4 ? (n < 2 ? (n == 0 ? l.a : l.b) : (n == 2 ? l.c : l.d)) : n == 4 ? l.e : n == 5 ? l.f : l.g;
}
void setLayer(inout Layers l, int n, uvec2 word) {
    if (n == 0) l.a = word;
    if (n == 1) l.b = word;
    if (n == 2) l.c = word;
    if (n == 3) l.d = word;
    if (n == 4) l.e = word;
    if (n == 5) l.f = word;
    if (n == 6) l.g = word;
}

uvec2 up(uvec2 v, int by) {
    uint n = uint(by & 31);
    uint carry = n == 0u ? 0u : v.x >> (32u - n);
    return by >= 32 ? uvec2(0u, v.x << n) : uvec2(v.x << n, (v.y << n) | carry);
}
uvec2 down(uvec2 v, int by) {
    uint n = uint(by & 31);
    uint carry = n == 0u ? 0u : v.y << (32u - n);
    return by >= 32 ? uvec2(v.y >> n, 0u) : uvec2((v.x >> n) | carry, v.y >> n);
}
bool isAny(uvec2 v) { return (v.x | v.y) != 0u; }

// Population count, and sums of x - 3 and of y - 3 over the set bits. SIMD within a register: counts of pairs, then
// nibbles, then bytes, each with the sum of x of its bits.
ivec3 sumsOf(uvec2 bits) {
    uvec2 xOfPair = (bits >> 1) & 0x55555555u, ofPair = bits - xOfPair, upper = (ofPair >> 2) & 0x33333333u;
    uvec2 ofNibble = (ofPair & 0x33333333u) + upper;
    uvec2 xOfNibble = (xOfPair & 0x33333333u) + ((xOfPair >> 2) & 0x33333333u) + 2u * upper;
    uvec2 upperNibble = (ofNibble >> 4) & 0x0F0F0F0Fu, ofByte = (ofNibble & 0x0F0F0F0Fu) + upperNibble;
    uvec2 xOfByte = (xOfNibble & 0x0F0F0F0Fu) + ((xOfNibble >> 4) & 0x0F0F0F0Fu) + 4u * upperNibble;
    uvec2 rows = (ofByte * uvec2(0x00010203u, 0x04050607u)) >> 24;
    int n = int(((ofByte.x + ofByte.y) * 0x01010101u) >> 24);
    return ivec3(n, int(((xOfByte.x + xOfByte.y) * 0x01010101u) >> 24) - 3 * n, int(rows.x + rows.y) - 3 * n);
}
int count64(uvec2 bits) { return sumsOf(bits).x; }

const uvec2 kDisc = uvec2(0x7F7F3E1Cu, 0x001C3E7Fu);
const uvec2 kMiddlePlace = uvec2(0x08000000u, 0u);

// The ball of kBallVoxels, by layer.
uvec2 ballOf(int z) {
    int aside = abs(z - 3);
    return aside < 2    ? kDisc
           : aside == 2 ? uvec2(0x3E3E3E00u, 0x00003E3Eu)
                        : uvec2(0x1C1C0000u, 0x0000001Cu);
}

bool isBody(uint number) {
    return number < styleCount && (elementOf(styles, kStyleTexels * number + 1u).x & kBodyBit) != 0u;
}

// Mask of the body voxels in one layer of a brick.
uvec2 bodyWord(ivec3 brick, uint layer) {
    uint place = uint(brick.x + brickCount.x * (brick.y + brickCount.y * brick.z));
    uint pattern = elementOf(patterns, place).x;
    if (pattern == kNone) return uvec2(isBody(elementOf(boxes, elementOf(brickIndex, place).x).w) ? 0xFFFFFFFFu : 0u);
    uvec4 head = elementOf(bricks, pattern);
    uvec2 body = uvec2(0u);
    for (uint entry = 0u; entry < 512u; ++entry) {
        if (entry >= head.w) break;
        if (!isBody(elementOf(palettes, head.x + entry).x)) continue;
        uvec2 equal = uvec2(0xFFFFFFFFu);
        for (uint bits = 0u; bits < 9u; ++bits) {
            if (bits >= head.z) break;
            uvec2 word = elementOf(words, head.y + 8u * bits + layer).xy;
            equal &= ((entry >> bits) & 1u) != 0u ? word : ~word;
        }
        body |= equal;
    }
    return body;
}

// Mask of the columns or rows of the window that are inside the volume, 7 bits.
uint insideBits(int first, int size) {
    int begin = clamp(-first, 0, 7), end = clamp(size - first, 0, 7);
    return (0x7Fu >> uint(7 - end)) & ~((1u << uint(begin)) - 1u);
}

uvec2 windowWord(ivec3 corner, int z) {
    int k = corner.z + z;
    if (k < 0 || k >= dimension.z) return uvec2(0u);
    uvec2 word = uvec2(0u);
    for (int n = 0; n < 4; ++n) {
        ivec3 brick = ivec3((corner.xy >> 3) + ivec2(n & 1, n >> 1), k >> 3);
        if (any(lessThan(brick, ivec3(0))) || any(greaterThanEqual(brick, brickCount))) continue;
        ivec2 aside = brick.xy * 8 - corner.xy;
        if (aside.x > 6 || aside.y > 6) continue;
        uvec2 body = bodyWord(brick, uint(k & 7));
        uint columns = (aside.x < 0 ? 0xFFu >> uint(-aside.x) : (0xFFu << uint(aside.x)) & 0xFFu) * 0x01010101u;
        body = (aside.x < 0 ? down(body, -aside.x) : up(body, aside.x)) & columns;
        word |= aside.y < 0 ? down(body, -8 * aside.y) : up(body, 8 * aside.y);
    }
    uint columns = insideBits(corner.x, dimension.x) * 0x01010101u, rows = insideBits(corner.y, dimension.y);
    // Expand each bit of `rows` to a byte.
    uvec2 spread = uvec2(rows & 15u, rows >> 4);
    spread = ((spread * 0x00204081u) & 0x01010101u) * 255u;
    return word & columns & spread;
}

// Layer `n` of the window across an axis; the bits of a layer run along (y, z), (x, z) or (x, y).
uvec2 layerAcross(Layers window, int across, int n) {
    if (across == 2) return layerOf(window, n);
    uvec2 layer = uvec2(0u);
    for (int z = 0; z < 7; ++z) {
        uvec2 word = layerOf(window, z);
        uint row = down(word, 8 * n).x & 0xFFu;
        uvec2 column = (((word >> uint(n)) & 0x01010101u) * 0x10204080u) >> 28;
        uint bits = across == 1 ? row : column.x | (column.y << 4);
        layer |= up(uvec2(bits, 0u), 8 * z);
    }
    return layer;
}

// The body's surface as a height field over the plane across an axis, see render::Heights.
Layers topsOf(Layers window, int across, int side, int layers) {
    Layers tops = Layers(uvec2(0u), uvec2(0u), uvec2(0u), uvec2(0u), uvec2(0u), uvec2(0u), uvec2(0u));
    uvec2 inner = uvec2(0u);
    for (int n = 0; n < layers; ++n) {
        uvec2 outer = layerAcross(window, across, side > 0 ? n : 6 - n);
        setLayer(tops, n - 1, inner & ~outer);
        inner = outer;
    }
    return tops;
}

// Keeps one height per place: those connected to the central one by height steps of at most one voxel.
void keepJoined(inout Layers tops, int rounds) {
    Layers joined = Layers(uvec2(0u), uvec2(0u), uvec2(0u), uvec2(0u), uvec2(0u), uvec2(0u), uvec2(0u));
    uvec2 reached = uvec2(0u);
    for (int n = 0; n < 5; ++n) {
        int h = n == 0 ? 2 : n == 1 ? 1 : n == 2 ? 3 : n == 3 ? 0 : 4;
        if (isAny(reached)) break;
        reached = layerOf(tops, h) & kMiddlePlace;
        setLayer(joined, h, reached);
    }
    for (int n = 0; n < rounds; ++n) {
        uvec2 before = reached, below = uvec2(0u), here = uvec2(0u), above = uvec2(0u);
        for (int h = -1; h < 6; ++h) {
            below = here;
            here = above;
            // The layer above `h`, as before this round.
            uvec2 next = h < 5 ? layerOf(joined, h + 1) : uvec2(0u);
            uvec2 row = next | up(next, 1) | down(next, 1);
            above = row | up(row, 8) | down(row, 8);
            if (h < 0) continue;
            uvec2 added = layerOf(tops, h) & (below | here | above) & ~reached;
            setLayer(joined, h, layerOf(joined, h) | added);
            reached |= added;
        }
        if (reached == before) break;
    }
    tops = joined;
}

uvec2 placesOf(Layers tops) { return tops.a | tops.b | tops.c | tops.d | tops.e | tops.f; }

// Slopes of the least-squares plane through the heights in the disc around the centre; z: their number, -1: no fit.
vec3 slopesOf(Layers tops) {
    uvec2 disc = placesOf(tops) & kDisc;
    ivec3 all = sumsOf(disc);
    if (all.x < kFacePlaces) return vec3(0.0, 0.0, -1.0);
    int spp = 0, sqq = 0, spq = 0;
    for (int n = 0; n < 7; ++n) {
        ivec3 inRow = sumsOf(disc & up(uvec2(0x7Fu, 0u), 8 * n));
        int r = n - 3;
        sqq += r * r * inRow.x;
        spq += r * inRow.y;
        spp += r * r * count64(disc & (0x01010101u << uint(n)));
    }
    ivec3 heights = ivec3(0);
    for (int h = 1; h < 6; ++h) heights += h * sumsOf(layerOf(tops, h) & disc);
    int cpp = all.x * spp - all.y * all.y, cqq = all.x * sqq - all.z * all.z, cpq = all.x * spq - all.y * all.z;
    int chp = all.x * heights.y - heights.x * all.y, chq = all.x * heights.z - heights.x * all.z;
    int scale = cpp * cqq - cpq * cpq;
    if (scale <= 0) return vec3(0.0, 0.0, -1.0);
    vec2 slopes = vec2(float(chp * cqq - chq * cpq), float(chq * cpp - chp * cpq)) / float(scale);
    return vec3(slopes, float(all.x));
}

vec3 slopeNormal(vec3 slopes, int across, float side) {
    return across == 0   ? vec3(side, -slopes.xy)
           : across == 1 ? vec3(-slopes.x, side, -slopes.y)
                         : vec3(-slopes.xy, side);
}

// Fitted normal, world space. `cavity`: how deep in a concave corner, 0..1. If not isNeeded, the face's normal, at
// little cost if no other ray of the SIMD group needs it.
vec3 fittedNormal(bool isNeeded, out float cavity) {
    int side = -componentOf(stride, axis), layers = isNeeded ? 7 : 0;
    vec3 faceNormal = vec3(axisVector(axis) * side);
    ivec3 corner = voxel + axisVector(axis) * side - 3;
    Layers window = Layers(uvec2(0u), uvec2(0u), uvec2(0u), uvec2(0u), uvec2(0u), uvec2(0u), uvec2(0u));
    ivec3 moment = ivec3(0);
    int voxels = 0;
    for (int z = 0; z < layers; ++z) {
        uvec2 word = windowWord(corner, z);
        setLayer(window, z, word);
        ivec3 sums = sumsOf(word & ballOf(z));
        voxels += sums.x;
        moment += ivec3(sums.yz, (z - 3) * sums.x);
    }
    cavity = clamp((float(voxels - kPlaneVoxels) / float(kBallVoxels) - kCavityFrom) * kCavityGain, 0.0, 1.0);

    vec3 fitted = faceNormal;
    int across = axis, along = side;
    bool hasMoment = false;
    for (int attempt = 0; attempt < 2; ++attempt) {
        if (!isNeeded) break;
        Layers tops = topsOf(window, across, along, layers);
        if (attempt == 0) {
            uvec2 others = tops.a | tops.b | tops.d | tops.e | tops.f;
            if (!isAny(others) && count64(tops.c) >= kFacePlaces) break;
        }
        keepJoined(tops, 3);
        uvec2 places = placesOf(tops);
        if (attempt == 0 && places == tops.c && count64(places) >= kFacePlaces) break;
        vec3 slopes = slopesOf(tops);
        vec3 normal = slopes.z < 0.0 ? -vec3(moment) : slopeNormal(slopes, across, float(along));
        if (attempt == 0) {
            if (slopes.z >= float(kGentlePlaces) && max(abs(slopes.x), abs(slopes.y)) <= 1.0) {
                fitted = normal;
                break;
            }
            ivec3 size = abs(moment);
            int longest = axis;
            if (size.x > componentOf(size, longest)) longest = 0;
            if (size.y > componentOf(size, longest)) longest = 1;
            if (size.z > componentOf(size, longest)) longest = 2;
            int ofLongest = componentOf(moment, longest);
            if (ofLongest == 0) break;
            int sideOfLongest = ofLongest > 0 ? -1 : 1;
            if (longest != axis) {
                across = longest;
                along = sideOfLongest;
                continue;
            }
            if (slopes.z >= 0.0) normal = slopeNormal(slopes, axis, float(sideOfLongest));
        }
        // The fitted normal must not point away from the side of the face that was hit.
        if (dot(normal, faceNormal) > 0.0) fitted = normal;
        break;
    }
    return worldNormal(fitted);
}
