/** Parts of the selection panel that load when they are first needed. */

import "./attribute_list";
import "./findings_list";
