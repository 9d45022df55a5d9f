// Normal and lighting of the surface at the start of a run.
uniform usampler2D styles, occlusion;
uniform uint styleCount;
uniform mat3 worldFromCovector;  // normals of planes from voxel space to world space
uniform mat3 indexFromWorld;     // for directions
uniform vec3 towardsLight;
uniform float lightKey, lightAmbient, lightOcclusion;
uniform int occlusionLevels;  // kOcclusionLevels; a uniform, so that compilers do not unroll the loop
uniform float occlusionCell;  // voxels along a block of the finest level; doubles with each level
uniform ivec3 occlusionCount[kOcclusionLevels];
uniform uint occlusionFirst[kOcclusionLevels];
uniform vec2 occlusionGain[kOcclusionLevels];  // gain, weight

vec3 view;  // towards the viewer

vec3 worldNormal(vec3 covector) { return normalize(worldFromCovector * covector); }

uvec3 planesOf(ivec3 brick) {
    uint entry = entryAt(brick);
    if (entry < uniformBoxes || entry >= boxCount) return uvec3(kNone);
    uint code = kCodeTexels * elementOf(boxes, entry).w;
    return uvec3(elementOf(codes, code + 1u).xy, elementOf(codes, code + 2u).x);
}

bool isNear(uint number, vec3 point) {
    if (number == kNone) return false;
    vec4 p = floatsOf(planes, number);
    return abs(dot(p.xyz, point) + p.w) < kSeamDistance && abs(componentOf(p.xyz, axis)) > kSeamSlope;
}

// Planes of adjacent bricks for one surface may not quite meet; see render::seamPlane().
uint seamPlane() {
    if (axis < 0 || (face & 7) != 0) return kNone;
    ivec3 onAxis = axisVector(axis);
    ivec3 entered = clamp(voxelAt(t), ivec3(0), dimension - 1);
    entered += (ivec3(face) - isBack - entered) * onAxis;
    vec3 point = origin + t * direction;
    for (int n = 0; n < 2; ++n) {
        uvec3 oblique = planesOf(clamp(entered - n * stride * onAxis, ivec3(0), dimension - 1) >> 3);
        if (isNear(oblique.x, point)) return oblique.x;
        if (isNear(oblique.y, point)) return oblique.y;
        if (isNear(oblique.z, point)) return oblique.z;
    }
    return kNone;
}

bool isAroundEye, isOblique;

// Normal of the cap, plane or voxel face that the ray crosses; world space, towards the viewer.
vec3 facingNormal(uint cap, bool isFirst) {
    isAroundEye = isOblique = false;
    if (cap != kNone) {
#if CLIPS
        vec3 normal = worldNormal(capDirection(cap, origin + t * direction));
        return dot(normal, view) < 0.0 ? -normal : normal;
#endif
    }
    uint oblique = plane != kNone || isFirst ? plane : seamPlane();
    isOblique = oblique != kNone;
    if (isOblique) {
        vec3 across = floatsOf(planes, oblique).xyz;
        return worldNormal(dot(across, direction) > 0.0 ? -across : across);
    }
    isAroundEye = axis < 0;
    return isAroundEye ? view : worldNormal(vec3(-stride * axisVector(axis)));
}

float lightOn(vec3 normal, float open) {
    float key = max(0.0, dot(normal, towardsLight)), facing = max(0.0, dot(normal, view));
    float sky = kSkyAside + kSkyAbove * normal.z;
    float ambient = lightAmbient * open * (kSkyShare * sky + kViewerShare * facing);
    return ambient + lightKey * key * (kKeyShut + kKeyOpen * open);
}

// Opaque voxels per block around a point, interpolated trilinearly.
float coverageAt(int level, vec3 point) {
    vec3 p = point / (occlusionCell * float(1 << level)) + 0.5;
    ivec3 count = occlusionCount[level];
    if (any(lessThanEqual(p, vec3(0.0))) || any(greaterThanEqual(p, vec3(count + 1)))) return 0.0;
    ivec3 corner = ivec3(p);
    vec3 f = p - vec3(corner);
    uint nextY = uint(count.x + 2), nextZ = nextY * uint(count.y + 2);
    uint first = occlusionFirst[level] + uint(corner.x) + nextY * uint(corner.y) + nextZ * uint(corner.z);
    float sum = 0.0;
    for (uint n = 0u; n < 4u; ++n) {
        uint row = first + (n & 1u) * nextY + (n >> 1) * nextZ;
        float along = mix(float(elementOf(occlusion, row).x), float(elementOf(occlusion, row + 1u).x), f.x);
        sum += along * ((n & 1u) != 0u ? f.y : 1.0 - f.y) * ((n >> 1) != 0u ? f.z : 1.0 - f.z);
    }
    return sum;
}

// 1 where nothing occludes, less in corners.
float openness(vec3 normal, float cavity, float at) {
    vec3 outwardIndex = indexFromWorld * normal;
    outwardIndex /= max(abs(outwardIndex.x), max(abs(outwardIndex.y), abs(outwardIndex.z)));
    vec3 point = origin + at * direction + vec3(middle);
    float taken = 0.0;
    for (int level = 0; level < occlusionLevels; ++level)
        taken += occlusionGain[level].y *
                 min(1.0, coverageAt(level, point + outwardIndex * occlusionCell * float(1 << level)) *
                              occlusionGain[level].x);
    return 1.0 - lightOcclusion * min(1.0, taken + kCavityOcclusion * cavity);
}
