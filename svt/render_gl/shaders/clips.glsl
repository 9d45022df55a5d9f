// Intervals that the clips leave of a ray. The table has per region: (mode, parts, element behind it, -); per part:
// (planes, rounds, -, -); per plane: normal and offset; per round body: center and kind, then the three rows of its
// frame. Positions as in ray.glsl.
uniform usampler2D clips;
uniform uint clipRegions;
uniform float clipSlack;  // in t; shorter intervals are rounding errors

// An interval inside a part. A face is 2 * number of its element, + 1 if it is round.
struct Stretch {
    float enter, leave;
    uint enterFace, leaveFace;
};

void meet(inout Stretch s, float from, float to, uint number) {
    if (from > s.enter) {
        s.enter = from;
        s.enterFace = number;
    }
    if (to < s.leave) {
        s.leave = to;
        s.leaveFace = number;
    }
}

void meetHalfSpace(inout Stretch s, uint number) {
    vec4 space = floatsOf(clips, number);
    float height = dot(space.xyz, origin) + space.w, slope = dot(space.xyz, direction);
    if (slope == 0.0)
        meet(s, -kFar, height > 0.0 ? kFar : -kFar, 2u * number);
    else if (slope > 0.0)
        meet(s, -height / slope, kFar, 2u * number);
    else
        meet(s, -kFar, -height / slope, 2u * number);
}

// Intersects the interval with a round body: the solutions of a t^2 + 2 b t + c < 0; of a cone, only one nappe.
void meetRound(inout Stretch s, uint number) {
    vec4 body = floatsOf(clips, number);
    vec3 x = floatsOf(clips, number + 1u).xyz, y = floatsOf(clips, number + 2u).xyz;
    vec3 z = floatsOf(clips, number + 3u).xyz;
    vec3 from = origin - body.xyz;
    vec3 o = vec3(dot(x, from), dot(y, from), dot(z, from));
    vec3 d = vec3(dot(x, direction), dot(y, direction), dot(z, direction));
    float along = body.w;  // 1 ball, 0 cylinder, -1 cone
    // Start where the ray is nearest to the center; elsewhere c loses its digits to cancellation.
    float back = dot(d, d) > 0.0 ? -dot(o, d) / dot(d, d) : 0.0;
    o += d * back;
    vec3 weight = vec3(1.0, 1.0, along);
    float a = dot(d * d, weight), b = dot(o * d, weight), c = dot(o * o, weight) - (along < 0.0 ? 0.0 : 1.0);
    uint code = 2u * number + 1u;
    float first = kFar, last = -kFar;
    float square = b * b - a * c;
    if (a == 0.0) {
        float at = b == 0.0 ? 0.0 : -c / (2.0 * b);
        bool isOut = b == 0.0 ? c >= 0.0 : along >= 0.0;
        bool isBehind = along < 0.0 && o.z + d.z * (b == 0.0 ? 0.0 : at + (b > 0.0 ? -1.0 : 1.0)) <= 0.0;
        if (!isOut && !isBehind) {
            first = b < 0.0 ? at + back : -kFar;
            last = b > 0.0 ? at + back : kFar;
        }
    } else if (square > 0.0 || a < 0.0) {
        float sum = -(b + (b < 0.0 ? -1.0 : 1.0) * sqrt(max(square, 0.0)));
        float t0 = sum / a, t1 = sum != 0.0 ? c / sum : t0;
        float near = min(t0, t1), far = max(t0, t1);
        if (a < 0.0) {
            first = d.z > 0.0 ? far + back : -kFar;
            last = d.z > 0.0 ? kFar : near + back;
        } else if (!(along < 0.0 && o.z + d.z * (near + far) * 0.5 <= 0.0)) {
            first = near + back;
            last = far + back;
        }
    }
    meet(s, first, last, code);
}

// Interval inside the part at element `number`, which is advanced past the part.
Stretch stretchOf(inout uint number) {
    Stretch s = Stretch(-kFar, kFar, kNone, kNone);
    uvec4 part = elementOf(clips, number++);
    for (uint n = 0u; n < kMaxFaces; ++n) {
        if (n >= part.x) break;
        meetHalfSpace(s, number++);
    }
    for (uint n = 0u; n < kMaxFaces; ++n) {
        if (n >= part.y) break;
        meetRound(s, number);
        number += 4u;
    }
    return s;
}

// Finds the next drawn interval: moves `from` to its start, and `to` to its end or to where two kept parts touch. `cap`
// is the clip face at the start, kNone if no clip made it. False if nothing is left before `to`.
bool nextInterval(inout float from, inout float to, out uint cap) {
    cap = kNone;
    float end = to;
    for (int attempt = 0; attempt < 80; ++attempt) {
        bool hasMoved = false;
        uint number = 0u;
        to = end;
        for (uint r = 0u; r < kMaxClipParts; ++r) {
            if (r >= clipRegions) break;
            uvec4 region = elementOf(clips, number++);
            bool isKept = region.x != 0u;
            float next = kFar, reached = -kFar;
            uint nextCap = kNone;
            for (uint p = 0u; p < kMaxClipParts; ++p) {
                if (p >= region.y) break;
                Stretch s = stretchOf(number);
                if (!(s.enter < s.leave)) continue;
                bool holds = s.enter <= from + (isKept ? 0.0 : clipSlack) && from + clipSlack < s.leave;
                if (holds && isKept) reached = max(reached, s.leave);
                if (holds && !isKept) {
                    from = s.leave;
                    cap = s.leaveFace;
                    hasMoved = true;
                }
                if (s.enter > from && s.enter < next) {
                    next = s.enter;
                    nextCap = s.enterFace;
                }
            }
            to = min(to, isKept ? reached : next);
            if (!isKept || reached > from) continue;
            from = next;
            cap = nextCap;
            hasMoved = true;
        }
        if (from >= end) return false;
        if (!hasMoved) return from < to;
    }
    return false;
}

// Normal of a clip face in voxel space; not of unit length.
vec3 capDirection(uint cap, vec3 point) {
    uint number = cap >> 1;
    vec4 head = floatsOf(clips, number);
    if ((cap & 1u) == 0u) return head.xyz;
    vec3 from = point - head.xyz;
    vec3 x = floatsOf(clips, number + 1u).xyz, y = floatsOf(clips, number + 2u).xyz;
    vec3 z = floatsOf(clips, number + 3u).xyz;
    return x * dot(x, from) + y * dot(y, from) + z * (head.w * dot(z, from));
}
