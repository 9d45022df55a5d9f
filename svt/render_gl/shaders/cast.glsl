// Casts one ray under one pass, and composites it with the passes before.
uniform usampler2D colorBefore, hitBefore;
uniform uint join;  // kJoinOver, ..., or kFirstPass
uniform float opaqueAt, labelAt;
uniform vec2 firstSample, perSample;  // first sample, from the picture's upper left corner; 2 / samples of the picture

layout(location = 0) out uvec4 sampleColor;  // bits of floats: linear light, premultiplied, and opacity
layout(location = 1) out uvec4 sampleHit;    // label, object, depth (float; kFar: none), normal; bit 30: cap, 31: lens

vec3 color;
float transmittance;
uint hitLabel, hitObject, hitHatch;
float hitDepth;
vec3 hitNormal;
bool hitIsCap, hasEnded;
// State of the current run.
uvec4 style;
uint runScalar, runCap;
float runFrom, surfaceLight;
vec3 surfaceNormal;
bool surfaceIsCap, runIsFirst, isSameObject;
// State of the current drawn interval.
uint object;
bool isFirst;

#if SHAPES
float shapeAt;  // t of the next line or triangle; kFar: none
float lineLight();
void addShape();
bool addCutBody(float at, uint cap);
void beginShapes(vec2 samplePlace);
void drawHiddenLines(inout float alpha);
vec2 raySpan;  // part of the ray inside the volume
#else
float lineLight() { return 1.0; }
#endif

bool hasHit() { return hitDepth < kFar; }

void add(float alpha) {
    float share = transmittance * alpha;
    float light = 1.0 + (surfaceLight - 1.0) * uintBitsToFloat(style.z);
    color += floatsOf(styles, kStyleTexels * scalar).rgb * (share * light * lineLight());
    transmittance -= share;
    if (hasHit() || 1.0 - transmittance <= labelAt) return;
    hitLabel = style.w;
    hitObject = style.y;
    hitHatch = style.x >> kHatchShift;
    hitDepth = runFrom + middleDepth;
    hitNormal = surfaceNormal;
    hitIsCap = surfaceIsCap;
}

bool isDone() { return 1.0 - transmittance >= opaqueAt; }

// Goes on to the next surface or shape to draw; false if the interval ends before. Adds translucent runs on the way.
bool findEvent(float to, bool isBeyond) {
    bool isNew = false;
    for (int steps = 0; steps < 65536; ++steps) {
#if SHAPES
        bool meetsShape = isBeyond ? shapeAt < kFar : shapeAt <= t;
        if (isBeyond || meetsShape) {
            isNew = meetsShape;
            break;
        }
#endif
        findStep();
        if (isFirst || scalar != runScalar) {
            runFrom = t;
            runScalar = scalar;
            runIsFirst = isFirst;
            isFirst = false;
        }
        style = scalar < styleCount ? elementOf(styles, kStyleTexels * scalar + 1u) : uvec4(0u);
        uint kind = style.x & kKindBits;
        if (kind == kHidden) {
            object = kNone;
        } else if (style.y != object || kind == kOpaque) {
            isSameObject = style.y == object;
            object = style.y;
            isNew = true;
            break;
        }
        float end = min(stepEnd, to);
#if SHAPES
        meetsShape = shapeAt <= end;
        if (meetsShape) end = shapeAt;
#endif
#if TRANSLUCENT
        if (kind == kTranslucent)
            add(1.0 - exp(-floatsOf(styles, kStyleTexels * scalar).a * metresPerT * max(end - t, 0.0)));
        hasEnded = isDone();
        if (hasEnded) break;
#endif
#if SHAPES
        if (meetsShape) {
            t = end;
            isNew = true;
            break;
        }
#endif
        if (stepEnd >= to || !takeStep()) break;
    }
    return isNew;
}

// Casts one drawn interval. isBeyond: the ray has left the volume or ended; only shapes are left.
void castInterval(float from, float to, uint cap, bool isBeyond) {
#if TRIANGLES && CLIPS
    if (cap != kNone && !isBeyond && addCutBody(from, cap)) hasEnded = true;
    if (hasEnded && !isBeyond) return;
#endif
    for (int event = 0; event < 8192; ++event) {
        if (!findEvent(to, isBeyond)) break;
#if SHAPES
        if (isBeyond ? shapeAt < kFar : shapeAt <= t) {
            addShape();
            hasEnded = hasEnded || isDone();
            if (hasEnded && !isBeyond) break;
            continue;
        }
#endif
        if (isSameObject) {
            hasEnded = true;
            break;
        }
        runCap = runIsFirst ? cap : kNone;
        surfaceIsCap = runCap != kNone;
        surfaceNormal = facingNormal(runCap, runIsFirst);
        hasEnded = (style.x & kKindBits) == kOpaque;
        if (hasEnded) break;
        surfaceLight = lightOn(surfaceNormal, 1.0);
    }
}

void lightSurface() {
    float cavity = 0.0;
#if FITTED
    bool isFitted = isVoxel && runCap == kNone && !isOblique && !isAroundEye;
    vec3 fitted = fittedNormal(isFitted, cavity);
    if (isFitted) surfaceNormal = fitted;
    else cavity = 0.0;
#endif
    float open = isAroundEye || lightOcclusion <= 0.0 ? 1.0 : openness(surfaceNormal, cavity, t);
    surfaceLight = lightOn(surfaceNormal, open);
}

void enterInterval(float from, int entryAxis) {
    enterAt(from, entryAxis);
    object = kNone;
    isFirst = true;
}

void castPass() {
    int entryAxis;
    vec2 span = spanInVolume(entryAxis);
    float from = span.x, to = span.y;
#if CLIPS
    for (int n = 0; n < 67; ++n) {
        uint cap = kNone;
        float before = from;
        to = span.y;
        bool isBeyond = hasEnded || !(from < to) || !nextInterval(from, to, cap);
        // Adjacent intervals count as one.
        if (!isBeyond && (n == 0 || from != before)) enterInterval(from, from == span.x ? entryAxis : -1);
        if (SHAPES == 1 || !isBeyond) castInterval(from, to, cap, isBeyond);
        if (isBeyond) break;
        from = to;
    }
#else
    enterInterval(from, entryAxis);
    for (int n = 0; n < 1 + SHAPES; ++n) {
        bool isBeyond = n > 0 || !(from < to);
        if (SHAPES == 1 || !isBeyond) castInterval(from, to, kNone, isBeyond);
    }
#endif
    bool isOpaque = hasEnded && !isDone();
#if !SHAPES
    // If the ray meets nothing, the cleared target is already right; discarding is cheaper than writing.
    if (join == kFirstPass && !isOpaque && transmittance >= 1.0) discard;
#endif
    if (isOpaque) {
        // There is no surface inside an object.
        if (!isSameObject) lightSurface();
        add(1.0);
    }
}

void main() {
    vec2 place = (gl_FragCoord.xy + firstSample) * perSample - 1.0;
    place.y = -place.y;
    color = vec3(0.0);
    transmittance = 1.0;
    hitLabel = hitObject = hitHatch = runScalar = 0u;
    hitDepth = kFar;
    hitNormal = vec3(0.0, 0.0, 1.0);
    hitIsCap = hasEnded = isSameObject = false;
    beginRay(place);
    view = normalize(-worldDirection);
#if SHAPES
    int entryAxis;
    raySpan = spanInVolume(entryAxis);
    beginShapes(gl_FragCoord.xy + firstSample);
#endif
    castPass();
    float alpha = 1.0 - transmittance * lineLight();
    if (alpha >= opaqueAt && alpha < 1.0) {
        color /= alpha;
        alpha = 1.0;
    }
#if SHAPES
    drawHiddenLines(alpha);
#endif
#if HATCHES
    if (hitIsCap) {
        float ink = inkOn(hitHatch, hitNormal, hitDepth);
        color = color * (1.0 - ink) + hatchColor * (ink * alpha);
    }
#endif
    ivec2 at = ivec2(gl_FragCoord.xy);
    uint normal = packedDirection(hitNormal) | (hitIsCap ? kCap : 0u);
    uvec4 hit = uvec4(hitLabel, hitObject, floatBitsToUint(hitDepth), normal);
    vec4 light = vec4(color, alpha);
    if (join != kFirstPass) {
        vec4 before = uintBitsToFloat(texelFetch(colorBefore, at, 0));
        uvec4 seen = texelFetch(hitBefore, at, 0);
        float depthBefore = uintBitsToFloat(seen.z);
        if (join == kJoinReplace) {
            if (alpha <= 0.0) {
                light = before;
                hit = seen;
            } else {
                hit.w |= kLens;
            }
        } else {
            bool isFront = join == kJoinOver || hitDepth <= depthBefore;
            vec4 front = isFront ? light : before, back = isFront ? before : light;
            light = front + back * (1.0 - front.a);
            bool isSeen = isFront ? hasHit() : depthBefore < kFar;
            hit = isSeen == isFront ? hit : seen;
        }
    }
    sampleColor = floatBitsToUint(light);
    sampleHit = hit;
}
