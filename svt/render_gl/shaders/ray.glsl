// Walks a ray through the bricks. Positions are in voxels relative to `middle`, a voxel near the centre of the volume;
// t is depth minus `middleDepth`, metres along the view direction. So all numbers stay small, and floats are precise
// enough.
uniform usampler2D brickIndex, boxes, codes, bricks, palettes, words, planes;
uniform uint uniformBoxes, boxCount;
uniform ivec3 dimension, brickCount, middle;
uniform vec3 rayMiddle, rayRight, rayUp;              // position of the ray through (u, v) at t = 0
uniform vec3 directionAhead, directionRight, directionUp;  // its direction, voxels per metre of depth
uniform vec3 worldAhead, worldRight, worldUp;         // its direction in world space
uniform float middleDepth;

vec3 origin, direction, inverse, worldDirection;
ivec3 stride, isBack;  // sign of the direction; 1 on axes with negative direction
bvec3 isStill;         // axes with zero direction
float metresPerT;

void beginRay(vec2 place) {
    origin = rayMiddle + rayRight * place.x + rayUp * place.y;
    direction = directionAhead + directionRight * place.x + directionUp * place.y;
    worldDirection = worldAhead + worldRight * place.x + worldUp * place.y;
    metresPerT = length(worldDirection);
    vec3 size = abs(direction);
    // A component this small is rounding noise.
    isStill = lessThanEqual(size, vec3(max(size.x, max(size.y, size.z)) * 1e-7));
    direction = mix(direction, vec3(0.0), isStill);
    inverse = 1.0 / mix(direction, vec3(1.0), isStill);
    stride = ivec3(sign(direction));
    isBack = ivec3(lessThan(direction, vec3(0.0)));
}

// Times at which the ray crosses one plane across each axis.
vec3 planeTimes(ivec3 plane) { return mix((vec3(plane - middle) - origin) * inverse, vec3(kFar), isStill); }

ivec3 voxelAt(float t) { return ivec3(floor(origin + t * direction)) + middle; }

int componentOf(ivec3 v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }
float componentOf(vec3 v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }
ivec3 axisVector(int axis) { return ivec3(axis == 0, axis == 1, axis == 2); }

uint entryAt(ivec3 brick) {
    return elementOf(brickIndex, uint(brick.x + brickCount.x * (brick.y + brickCount.y * brick.z))).x;
}

uint voxelScalar(uint pattern, ivec3 voxel) {
    uvec4 brick = elementOf(bricks, pattern);
    int bit = voxel.x + 8 * voxel.y;
    uint number = 0u;
    for (uint plane = 0u; plane < 9u; ++plane) {
        if (plane >= brick.z) break;
        uvec2 word = elementOf(words, brick.y + 8u * plane + uint(voxel.z)).xy;
        number |= (((bit < 32 ? word.x : word.y) >> uint(bit & 31)) & 1u) << plane;
    }
    return elementOf(palettes, brick.x + number).x;
}

// Position of the ray: its voxel, or any voxel of the box that it is in; and how it got there.
ivec3 voxel;
float t;
int axis;    // axis of the voxel face that it crossed, or -1
int face;    // that face's plane
uint plane;  // the oblique plane that it crossed, or kNone
// The current step, set by findStep(): its scalar, and where it ends.
uint scalar;
bool isVoxel;
float stepEnd;
ivec3 low, high, exitPlane;
vec3 exitTimes;
bool endsInside;
int nextAxis, nextFace;
uint nextPlane;

void meetCut(float time, int place, int cutAxis, inout uint side, inout uint bit) {
    bool isAfter = t >= time;
    int along = componentOf(stride, cutAxis);
    bool isBeyondAfter = along > 0 || (along == 0 && componentOf(voxel, cutAxis) < place);
    if (isAfter == isBeyondAfter) side |= bit;
    bit <<= 1;
    if (isAfter || time >= stepEnd) return;
    stepEnd = time;
    nextAxis = cutAxis;
    nextFace = place;
    nextPlane = kNone;
    endsInside = true;
}

void meetPlane(uint number, inout uint side, inout uint bit) {
    if (number == kNone) return;
    vec4 p = floatsOf(planes, number);
    float height = dot(p.xyz, origin) + p.w, rise = dot(p.xyz, direction);
    float time = rise != 0.0 ? -height / rise : kFar;
    bool isRising = rise != 0.0 ? rise > 0.0 : height <= 0.0;
    bool isAfter = t >= time;
    if (isAfter == isRising) side |= bit;
    bit <<= 1;
    if (isAfter || time >= stepEnd) return;
    stepEnd = time;
    nextAxis = -1;
    nextPlane = number;
    endsInside = true;
}

void findStep() {
    uint entry = entryAt(voxel >> 3);
    isVoxel = entry >= boxCount;
    uvec4 box = elementOf(boxes, isVoxel ? 0u : entry);
    low = ivec3(box.x & 0xFFFFu, box.x >> 16, box.y & 0xFFFFu);
    high = ivec3(box.y >> 16, box.z & 0xFFFFu, box.z >> 16);
    scalar = box.w;
    if (isVoxel) {
        low = voxel;
        high = voxel + 1;
        scalar = voxelScalar(entry - boxCount, voxel & 7);
    }
    exitPlane = high + (low - high) * isBack;
    exitTimes = planeTimes(exitPlane);
    stepEnd = min(exitTimes.x, min(exitTimes.y, exitTimes.z));
    endsInside = false;
    if (isVoxel || entry < uniformBoxes) return;
    uint code = kCodeTexels * scalar;
    uvec2 cuts = elementOf(codes, code).xy, oblique = elementOf(codes, code + 1u).xy;
    uvec2 rest = elementOf(codes, code + 2u).xy;  // third plane, first label
    uint axes = cuts.y >> 16, side = 0u, bit = 1u;
    ivec3 place = ivec3(cuts.x & 0xFFFFu, cuts.x >> 16, cuts.y & 0xFFFFu);
    vec3 times = planeTimes(place);
    if ((axes & 1u) != 0u) meetCut(times.x, place.x, 0, side, bit);
    else if ((axes & 8u) != 0u) meetPlane(uint(place.x) | (axes >> 6 & 7u) << 16, side, bit);
    if ((axes & 2u) != 0u) meetCut(times.y, place.y, 1, side, bit);
    else if ((axes & 16u) != 0u) meetPlane(uint(place.y) | (axes >> 9 & 7u) << 16, side, bit);
    if ((axes & 4u) != 0u) meetCut(times.z, place.z, 2, side, bit);
    else if ((axes & 32u) != 0u) meetPlane(uint(place.z) | (axes >> 12 & 7u) << 16, side, bit);
    meetPlane(oblique.x, side, bit);
    meetPlane(oblique.y, side, bit);
    meetPlane(rest.x, side, bit);
    scalar = elementOf(palettes, rest.y + side).x;
}

// Moves to the end of the step; false if that is outside the volume.
bool takeStep() {
    if (endsInside) {
        t = stepEnd;
        axis = nextAxis;
        face = nextFace;
        plane = nextPlane;
        return true;
    }
    ivec3 isLeft = ivec3(lessThanEqual(exitTimes, vec3(stepEnd)));
    ivec3 inside = clamp(voxelAt(stepEnd), low, high - 1);
    voxel = inside + (exitPlane - isBack - inside) * isLeft;
    axis = isLeft.x != 0 ? 0 : isLeft.y != 0 ? 1 : 2;
    face = componentOf(exitPlane, axis);
    plane = kNone;
    t = max(t, stepEnd);
    return all(greaterThanEqual(voxel, ivec3(0))) && all(lessThan(voxel, dimension));
}

// Part of the ray inside the volume, in front of the eye. `entry`: axis of the face by which it enters; -1: the eye is
// inside.
vec2 spanInVolume(out int entry) {
    vec3 a = planeTimes(ivec3(0)), b = planeTimes(dimension);
    vec3 near = mix(min(a, b), vec3(-kFar), isStill), far = max(a, b);
    float from = max(near.x, max(near.y, near.z)), to = min(far.x, min(far.y, far.z));
    entry = near.x == from ? 0 : near.y == from ? 1 : 2;
    if (from < -middleDepth) {
        from = -middleDepth;
        entry = -1;
    }
    ivec3 place = voxelAt(0.0);
    ivec3 isOutside = ivec3(lessThan(place, ivec3(0))) + ivec3(greaterThanEqual(place, dimension));
    return any(bvec3(ivec3(isStill) * isOutside)) ? vec2(0.0) : vec2(from, to);
}

void enterAt(float from, int entryAxis) {
    t = from;
    voxel = clamp(voxelAt(from), ivec3(0), dimension - 1);
    axis = entryAxis;
    plane = kNone;
    if (axis < 0) return;
    face = componentOf(isBack, axis) * componentOf(dimension, axis);
    ivec3 onAxis = axisVector(axis);
    voxel += (ivec3(face) - isBack - voxel) * onAxis;
}
