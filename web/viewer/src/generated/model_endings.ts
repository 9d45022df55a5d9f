/**
 * The endings of model files, as the readers of the library declare them.
 * scripts/update_options.py generates this file; manual changes are lost.
 */

export const kModelEndings = [".gml", ".xml", ".citygml", ".json", ".jsonl", ".cityjson", ".ifc", ".ifczip"] as const;
