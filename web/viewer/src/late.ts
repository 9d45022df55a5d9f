import { loadTerms } from "./state/class_words";

/** Loads the scripts that are otherwise fetched when they are first used, so that the page then needs no connection. */
export async function loadLate(): Promise<void> {
  await Promise.all([
    import("./basemap/basemap_choice"),
    import("./canvas/section_panes"),
    import("./city/city_search"),
    import("./comparing/changes_panel"),
    import("./panels/color_legend"),
    import("./panels/command_palette"),
    import("./panels/context_menu"),
    import("./panels/details"),
    import("./panels/help_dialog"),
    import("./fields/field_choice"),
    import("./fields/probe"),
    import("./panels/feature_groups"),
    import("./panels/object_table"),
    loadTerms(),
    import("./quantities/quantities_panel"),
    import("./state/bcf"),
    import("./tools/aim_layer"),
    import("./tools/print_sheets"),
    import("./tools/walk_pad"),
  ]);
  await import("./reports/reports_module").then(({ prepareReports }) => prepareReports());
  performance.mark("svt-all-scripts");
}
