vec3 fittedNormal(out float crease) { crease = 0.0; return worldNormal(vec3(-stride * axisVector(axis))); }
