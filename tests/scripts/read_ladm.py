#!/usr/bin/env python3
"""Reads the GeoPackage of `svt cadastre` with GDAL and SQLite: foreign keys, valid geometries, areas and heights.

    read_ladm.py UNITS.gpkg     exit code 77 where GDAL is not installed; prints counts as JSON
"""
import json
import sqlite3
import sys

try:
    from osgeo import ogr
except ImportError:
    print("no GDAL")
    sys.exit(77)

TABLES = {
    "la_party": None,
    "la_baunit": None,
    "la_right": None,
    "la_restriction": None,
    "la_responsibility": None,
    "la_spatialunit": "MULTIPOLYGON",
    "la_boundaryface": "POLYGON",
    "la_relation": None,
    "la_relation_face": None,
    "la_source": None,
}


def check_keys(path):
    database = sqlite3.connect(path)
    broken = database.execute("PRAGMA foreign_key_check").fetchall()
    assert not broken, broken
    for table in (
        "la_right",
        "la_restriction",
        "la_responsibility",
        "la_spatialunit",
        "la_boundaryface",
        "la_relation",
        "la_relation_face",
    ):
        assert database.execute(f"PRAGMA foreign_key_list({table})").fetchall(), table
    bad = database.execute("PRAGMA integrity_check").fetchall()
    assert bad == [("ok",)], bad
    return database


def area_in_space(polygon):
    """m2 of a polygon with heights, by Newell's vector of each ring."""
    total = [0.0, 0.0, 0.0]
    for n in range(polygon.GetGeometryCount()):
        points = polygon.GetGeometryRef(n).GetPoints()
        for (x0, y0, z0), (x1, y1, z1) in zip(points, points[1:]):
            total[0] += (y0 - y1) * (z0 + z1) / 2
            total[1] += (z0 - z1) * (x0 + x1) / 2
            total[2] += (x0 - x1) * (y0 + y1) / 2
    return sum(t * t for t in total) ** 0.5


def main():
    path = sys.argv[1]
    ogr.UseExceptions()
    data = ogr.Open(path)
    layers = {data.GetLayer(n).GetName(): data.GetLayer(n) for n in range(data.GetLayerCount())}
    assert set(layers) == set(TABLES), sorted(layers)
    for name, kind in TABLES.items():
        geometry = ogr.GeometryTypeToName(layers[name].GetGeomType())
        assert (kind is None) == (geometry == "None"), (name, geometry)
    assert layers["la_boundaryface"].GetGeomType() == ogr.wkbPolygon25D, "faces have heights"
    for feature in layers["la_spatialunit"]:
        geometry = feature.GetGeometryRef()
        if geometry is None:
            continue
        assert geometry.IsValid(), feature["suid"]
        assert abs(geometry.GetArea() - feature["area"]) <= 1e-3 * feature["area"], feature["suid"]
    for feature in layers["la_boundaryface"]:
        geometry = feature.GetGeometryRef()
        heights = [p[2] for n in range(geometry.GetGeometryCount()) for p in geometry.GetGeometryRef(n).GetPoints()]
        assert abs(min(heights) - feature["low"]) < 1e-6 and abs(max(heights) - feature["high"]) < 1e-6
        assert abs(area_in_space(geometry) - feature["area"]) <= 1e-3 * feature["area"] + 1e-5, feature["bfid"]
    reference = layers["la_spatialunit"].GetSpatialRef()
    counts = {name: layer.GetFeatureCount() for name, layer in layers.items()}
    counts["epsg"] = int(reference.GetAuthorityCode(None)) if reference and reference.GetAuthorityCode(None) else None
    database = check_keys(path)
    counts["shares"] = dict(
        database.execute(
            "SELECT u.uid || ' ' || p.name, r.share_numerator || '/' || r.share_denominator FROM la_right r "
            "JOIN la_party p ON r.party = p.fid JOIN la_baunit u ON r.baunit = u.fid"
        ).fetchall()
    )
    counts["restrictions"] = database.execute(
        "SELECT u.uid, r.type, p.name, r.share, s.name FROM la_restriction r JOIN la_party p ON r.party = p.fid "
        "JOIN la_baunit u ON r.baunit = u.fid JOIN la_source s ON r.source = s.fid"
    ).fetchall()
    counts["volumes"] = dict(database.execute("SELECT suid, body_volume FROM la_spatialunit").fetchall())
    print(json.dumps(counts))


main()
