// What tests find in the page.
interface HTMLElementTagNameMap {
  "svt-app": import("../../src/app").App;
  "svt-changes": import("../../src/comparing/changes_panel").ChangesPanel;
  "svt-share-tool": import("../../src/tools/share_tool").ShareTool;
}
