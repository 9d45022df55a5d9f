// What tests find in the page.
interface HTMLElementTagNameMap {
  "svt-app": import("../src/app").App;
  "svt-share-tool": import("../src/tools/share_tool").ShareTool;
}
