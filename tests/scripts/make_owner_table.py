#!/usr/bin/env python3
"""Makes a table of owners in an SQLite file, a file without one, and a file whose table has no end.

    make_owner_table.py OWNERS.gpkg OTHER.gpkg ENDLESS.gpkg
"""
import sqlite3
import sys

database = sqlite3.connect(sys.argv[1])
database.execute("CREATE TABLE other(a)")
database.execute(
    "CREATE TABLE owners(fid INTEGER PRIMARY KEY, Owner TEXT, Feature TEXT, Share REAL, Right TEXT, Source TEXT)"
)
rows = [
    ("tower_S00_F1", "Weber, A.", 0.5, None, "deed 7"),
    ("tower_S00_F1", "Klein", 0.5, "ownership", None),
    ("tower_S00_F2", "Weber, A.", None, None, None),
    ("tower_S00_F1", "Bank", None, "mortgage", "deed 8"),
]
database.executemany("INSERT INTO owners(Feature, Owner, Share, Right, Source) VALUES(?, ?, ?, ?, ?)", rows)
database.commit()

database = sqlite3.connect(sys.argv[2])
database.execute("CREATE TABLE t(a)")
database.commit()

database = sqlite3.connect(sys.argv[3])
endless = "WITH RECURSIVE c(x) AS (SELECT 1 UNION ALL SELECT x FROM c)"
database.execute(f"CREATE VIEW owners AS {endless} SELECT x AS feature, x AS owner FROM c WHERE x > 1")
database.commit()
