/**
 * The endings of model files, as the readers of the library declare them.
 * Written by scripts/update_options.py; a change by hand is lost.
 */

export const kModelEndings = [".gml", ".xml", ".citygml", ".json", ".jsonl", ".cityjson", ".ifc", ".ifczip"] as const;
