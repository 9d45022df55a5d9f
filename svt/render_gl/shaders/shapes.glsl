// Lines and triangles that a ray meets, in order of depth. Only the next one of each kind is kept; when it has been
// drawn, the one after it is searched for.
uniform usampler2D shapeSquares, shapeList, shapeTable;  // by square of the picture; numbers of shapes; the shapes
uniform ivec2 shapeSquareCount;
uniform uint lineStylesFirst, trianglesFirst;  // first element in shapeTable
uniform float lineSamples;                // along a pixel
uniform float linePixelPerDepth, linePixelSize;  // size of a pixel, metres: per metre of depth, and constant
uniform float depthBias, lineTogether;   // metres: depth bias; lines this close in depth are one
uniform bool isPerspective;
uniform vec3 worldOriginRight, worldOriginUp;  // position of rays at t = 0, relative to the view axis
uniform float samplesAPixel;

vec2 pixelPlace;
uvec4 shapes;  // of the ray's square: first element of shapeList, number of lines, of triangles
float linesLeft;
vec3 worldOrigin;

// The next line, and the next triangle; depths are in t.
float lineAt, lineEnd, lineOpacity, lineHidden;
vec3 nextLineColor, strongestColor;
float strongestHidden;
float triangleAt;
uint nextTriangle;
bool triangleEnters;

float lineLight() { return linesLeft; }

// t at which the ray meets a line; kFar if it does not.
float meetLine(uint number, out float coverage, out float hidden, out uint lineStyle) {
    vec4 place = floatsOf(shapeTable, kLineTexels * number), depths = floatsOf(shapeTable, kLineTexels * number + 1u);
    lineStyle = elementOf(shapeTable, kLineTexels * number + 2u).x;
    vec4 first = floatsOf(shapeTable, lineStylesFirst + kLineStyleTexels * lineStyle),
         more = floatsOf(shapeTable, lineStylesFirst + kLineStyleTexels * lineStyle + 1u);
    vec2 aside = pixelPlace - place.xy;
    float along = clamp(dot(aside, place.zw) * depths.x, 0.0, 1.0);
    coverage = min((first.w - length(aside - along * place.zw)) * lineSamples + 0.5, more.x);
    hidden = 0.0;
    if (coverage <= 0.0) return kFar;
    uint kind = elementOf(shapeTable, lineStylesFirst + kLineStyleTexels * lineStyle + 2u).x;
    if (kind != kHiddenLinesNone) hidden = coverage * more.y;
    float pixels = along * depths.w;
    if (kind == kHiddenLinesDashed && pixels - floor(pixels / more.w) * more.w > more.z) hidden = 0.0;
    float seen = depths.y + depths.z * along, depth = isPerspective ? 1.0 / seen : seen;
    float bias = depthBias + kHalfWidthsBefore * first.w * (linePixelPerDepth * depth + linePixelSize);
    return max(depth - bias, 0.0) - middleDepth;
}

// Lines within lineTogether of depth count as one, as strong as the strongest.
void findLine() {
    float coverage, hidden;
    uint lineStyle;
    lineAt = kFar;
    for (uint n = 0u; n < shapes.y; ++n) {
        float at = meetLine(elementOf(shapeList, shapes.x + n).x, coverage, hidden, lineStyle);
        if (at > lineEnd) lineAt = min(lineAt, at);
    }
    if (lineAt >= kFar) return;
    lineEnd = lineAt + lineTogether;
    lineOpacity = lineHidden = 0.0;
    float nearest = kFar;
    for (uint n = 0u; n < shapes.y; ++n) {
        float at = meetLine(elementOf(shapeList, shapes.x + n).x, coverage, hidden, lineStyle);
        if (at < lineAt || at > lineEnd) continue;
        lineHidden = max(lineHidden, hidden);
        if (coverage < lineOpacity || (coverage == lineOpacity && at >= nearest)) continue;
        lineOpacity = coverage;
        nearest = at;
        nextLineColor = floatsOf(shapeTable, lineStylesFirst + kLineStyleTexels * lineStyle).rgb;
    }
}

#if TRIANGLES
#if CLIPS
bool isDrawnAt(float at) {
    uint number = 0u;
    for (uint r = 0u; r < kMaxClipParts; ++r) {
        if (r >= clipRegions) break;
        uvec4 region = elementOf(clips, number++);
        bool isInside = false;
        for (uint p = 0u; p < kMaxClipParts; ++p) {
            if (p >= region.y) break;
            Stretch s = stretchOf(number);
            isInside = isInside || (s.enter <= at && at < s.leave);
        }
        if (isInside != (region.x != 0u)) return false;
    }
    return at >= raySpan.x && at < raySpan.y;
}
#else
bool isDrawnAt(float at) { return at >= raySpan.x && at < raySpan.y; }
#endif

// t at which the ray crosses a triangle; kFar if it does not.
float meetTriangle(uint number, out bool isEntering) {
    uint first = trianglesFirst + kTriangleTexels * number;
    vec4 corner = floatsOf(shapeTable, first), second = floatsOf(shapeTable, first + 1u);
    vec4 third = floatsOf(shapeTable, first + 2u), across = floatsOf(shapeTable, first + 3u);
    vec3 a = corner.xyz - worldOrigin, b = second.xyz - worldOrigin, c = third.xyz - worldOrigin;
    vec3 sides = worldDirection * mat3(cross(b, c), cross(c, a), cross(a, b));
    bool isInside = all(greaterThanEqual(sides, vec3(0.0))) || all(lessThanEqual(sides, vec3(0.0)));
    float facing = dot(across.xyz, worldDirection);
    isEntering = facing < 0.0;
    if (!isInside || facing == 0.0) return kFar;
    float at = dot(across.xyz, a) / facing;
    return at > -middleDepth ? at : kFar;
}

uint objectOf(uint triangle) { return elementOf(shapeTable, trianglesFirst + kTriangleTexels * triangle + 5u).y; }

void findTriangle() {
    float after = triangleAt;
    uint last = nextTriangle, object = after > -kFar ? objectOf(last) : 0u;
    bool wasEntering = triangleEnters;
    triangleAt = kFar;
    for (uint n = 0u; n < shapes.z; ++n) {
        uint number = elementOf(shapeList, shapes.x + shapes.y + n).x & ~kTriangle;
        bool isEntering;
        float at = meetTriangle(number, isEntering);
        if (at < after || (at == after && number <= last) || at >= triangleAt) continue;
        // Two triangles hit on their shared edge count once.
        bool isSame = after > -kFar && at - after <= 1e-6 * (abs(after) + middleDepth) && isEntering == wasEntering &&
                      objectOf(number) == object;
        if (isSame || !isDrawnAt(at)) continue;
        triangleAt = at;
        nextTriangle = number;
        triangleEnters = isEntering;
    }
}

void addSurface(uint number, vec3 normal, float at, bool isCap) {
    uint first = trianglesFirst + kTriangleTexels * number;
    vec4 surfaceStyle = floatsOf(shapeTable, first + 4u);
    uvec4 kind = elementOf(shapeTable, first + 5u);
    bool isOpen = (kind.x & kBodyBit) == 0u || lightOcclusion <= 0.0;
    float lit = lightOn(normal, isOpen ? 1.0 : openness(normal, 0.0, at));
    float share = transmittance * surfaceStyle.a;
    color += surfaceStyle.rgb * ((1.0 + (lit - 1.0) * uintBitsToFloat(kind.z)) * share * linesLeft);
    transmittance -= share;
    if (hasHit() || 1.0 - transmittance <= labelAt) return;
    hitLabel = kind.w;
    hitObject = kind.y;
    hitHatch = kind.x >> kHatchShift;
    hitDepth = at + middleDepth;
    hitNormal = normal;
    hitIsCap = isCap;
}

#if CLIPS
// Finds the body that the ray is inside at a clip face: the one entered last. An object that the ray does not enter as
// often as it leaves it is an open sheet, not a body. If the body is opaque, draws its cap and returns true: the ray
// ends.
bool addCutBody(float at, uint cap) {
    float before = kFar;
    for (int n = 0; n < 64; ++n) {
        float latest = -kFar;
        uint object = 0u;
        for (uint m = 0u; m < shapes.z; ++m) {
            uint number = elementOf(shapeList, shapes.x + shapes.y + m).x & ~kTriangle;
            bool isEntering;
            float met = meetTriangle(number, isEntering);
            if (met > at || met >= before || met <= latest) continue;
            latest = met;
            object = objectOf(number);
        }
        if (latest <= -kFar) return false;
        int balance = 0, inside = 0;
        float entered = -kFar;
        uint body = 0u;
        for (uint m = 0u; m < shapes.z; ++m) {
            uint number = elementOf(shapeList, shapes.x + shapes.y + m).x & ~kTriangle;
            bool isEntering;
            float met = meetTriangle(number, isEntering);
            if (met >= kFar || objectOf(number) != object) continue;
            int turn = isEntering ? 1 : -1;
            balance += turn;
            if (met > at) continue;
            inside += turn;
            if (!isEntering || met < entered) continue;
            entered = met;
            body = number;
        }
        before = latest;
        if (balance != 0 || inside <= 0) continue;
        uint flags = elementOf(shapeTable, trianglesFirst + kTriangleTexels * body + 5u).x;
        if ((flags & kKindBits) != kOpaque) return false;
        vec3 normal = worldNormal(capDirection(cap, origin + at * direction));
        addSurface(body, dot(normal, worldDirection) > 0.0 ? -normal : normal, at, true);
        return true;
    }
    return false;
}
#endif

#endif

void beginShapes(vec2 samplePlace) {
    pixelPlace = samplePlace / samplesAPixel;
    ivec2 square = clamp(ivec2(pixelPlace * (1.0 / float(kSquarePixels))), ivec2(0), shapeSquareCount - 1);
    shapes = elementOf(shapeSquares, uint(square.x + shapeSquareCount.x * square.y));
    vec2 place = samplePlace * perSample - 1.0;
    worldOrigin = worldOriginRight * place.x - worldOriginUp * place.y;
    linesLeft = 1.0;
    lineOpacity = lineHidden = strongestHidden = 0.0;
    nextLineColor = strongestColor = vec3(0.0);
    nextTriangle = 0u;
    triangleEnters = false;
    // Start with shapes at -kFar that draw nothing; the first real ones are searched for behind them.
    lineEnd = lineAt = shapeAt = shapes.y + shapes.z > 0u ? -kFar : kFar;
    triangleAt = shapes.z > 0u ? -kFar : kFar;
}

// Draws the next shape, and finds the one after it. Keeps the strongest line behind the end of the ray.
void addShape() {
    bool isOver = hasEnded || isDone();
    if (lineAt <= triangleAt) {
        if (!isOver) {
            color += nextLineColor * (transmittance * lineOpacity * linesLeft);
            linesLeft *= 1.0 - lineOpacity;
        } else if (lineHidden > strongestHidden) {
            strongestHidden = lineHidden;
            strongestColor = nextLineColor;
        }
        findLine();
    } else {
#if TRIANGLES
        if (!isOver && triangleAt > -kFar) {
            vec3 normal = floatsOf(shapeTable, trianglesFirst + kTriangleTexels * nextTriangle + 3u).xyz;
            addSurface(nextTriangle, triangleEnters ? normal : -normal, triangleAt, false);
        }
        findTriangle();
        if (isOver) triangleAt = kFar;
#endif
    }
    shapeAt = min(lineAt, triangleAt);
}

// Draws the strongest hidden line over the place where the ray has ended.
void drawHiddenLines(inout float alpha) {
    color = color * (1.0 - strongestHidden) + strongestColor * strongestHidden;
    alpha += (1.0 - alpha) * strongestHidden;
}
