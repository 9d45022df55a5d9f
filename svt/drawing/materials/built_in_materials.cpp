#include <svt/core/check.hpp>
#include <svt/drawing/material_table.hpp>

namespace svt::drawing {
namespace {

// In order of precedence. Coverings come before the materials that they are named after: "brick tiles", "sand screed".
constexpr std::string_view kMaterials = R"(
glass,no,insulating glass|glazing|glass block|glass brick|*verglasung|isolierglas|glasbaustein*|vitrage
insulation,no,insulation|insulating|batt|wool|fiberglass|fibreglass|polystyrene|polyurethane|eps|xps|pur|pir|foam|cork
insulation,no,*dämm*|*daemm*|*wolle|*schaum*|styropor|*isolierung|isolant|isolation|laine|polystyrène|liège|mousse
insulation,no,*isolatie*|*wol|*isolasjon*|*isoler*|mineralull|glassull|steinull|stenull|glasull|cellplast|*eriste*
insulation,no,mineraalivilla|kivivilla|lasivilla|aislante|aislamiento|lana|poliestireno|poliuretano|corcho|isolante
insulation,no,isolamento|polistirene|sughero|断熱|グラスウール|ロックウール|発泡|ウレタン
timber,yes,wood stud|timber stud|timber frame|wood framing|*holzständer*|ossature bois|träregel*|trestender*
general,no,stud|metal stud|furring|metal framing|*ständer*|cw profil*|uw profil*|ossature métallique|montant|stålregel*
general,no,stålstender*|metal stud*|montanti|perfilería|軽量鉄骨
none,no,air|cavity|luft|*luftschicht|luftspalt*|lame d air|vide|spouw|*luchtspouw|ilmaväli|*rako|cámara|aria|空気層
general,no,membrane|vapor|vapour|retarder|damp proofing|waterproofing|felt|foil|bitum*|*folie|*bahn|*abdichtung
general,no,*bremse|*sperre|étanchéité|dampsperre|ångspärr|höyrynsulku|impermeabilización|guaina|防水|防湿
general,no,tile|roof tile|ceramic|carpet|paint|vinyl|linoleum|*fliese*|*teppich|*anstrich|dachziegel|dachstein
general,no,carrelage|peinture|moquette|tegel|flis|fliser|kakel|azulejo|baldosa|teja|pintura|piastrelle|tegola|タイル
concrete,no,screed|plaster|mortar|render|stucco|gypsum|plasterboard|drywall|cement|*estrich|*putz|*mörtel|*gips*
concrete,no,zement*|enduit|plâtre|mortier|chape|ciment|*pleister|stucwerk|*dekvloer|puss|mørtel|murbruk|påstøp|*laasti
concrete,no,rappaus|kipsi*|mortero|yeso|enlucido|revoco|cemento|intonaco|malta|massetto|gesso|モルタル|石膏|漆喰
masonry,yes,masonry|brick|brickwork|block|concrete block|blockwork|cmu|stone|stonework|sandstone|limestone|granite
masonry,yes,marble|adobe|aerated concrete|aac|terracotta|*ziegel*|*mauerwerk|*stein|porenbeton|gasbeton|bims*|*klinker
masonry,yes,poroton|ytong|granit|marmor|maçonnerie|brique|parpaing|pierre|moellon|béton cellulaire|metselwerk
masonry,yes,*baksteen|*steen|cellenbeton|*murverk|*tegl*|tegelsten|*lättbetong|leca*|siporex|porebetong|*sten|*tiili*
masonry,yes,*harkko*|*kivi|ladrillo|mampostería|bloque|piedra|muratura|mattone|mattoni|laterizio|pietra|blocchi
masonry,yes,calcestruzzo cellulare|レンガ|煉瓦|ブロック|石材|大理石
concrete,yes,plain concrete|unreinforced concrete|mass concrete|lean concrete|unbewehrt*|magerbeton|béton maigre
concrete,yes,béton de propreté|magerbetong|hormigón en masa|hormigón de limpieza|calcestruzzo magro|捨コン
reinforced-concrete,yes,concrete|reinforced concrete|precast|*beton*|béton|betong*|*betong|hormigón|hormigon|concreto
reinforced-concrete,yes,calcestruzzo|cemento armato|stb|コンクリート
timber,yes,wood|timber|lumber|softwood|hardwood|plywood|osb|mdf|glulam|clt|lvl|oak|pine|spruce|birch|cherry|mahogany
timber,yes,beech|parquet|*holz*|bsh|*spanplatte*|eiche|fichte|kiefer|parkett|bois|contreplaqué|chêne|*hout|multiplex
timber,yes,tre|trä|træ|*trä|limtre|sponplate*|spånskiv*|furu|*puu|vaneri|mänty|kuusi|madera|contrachapado|roble
timber,yes,legno|compensato|lamellare|rovere|木|合板|集成材
steel,yes,steel|metal|iron|aluminium|aluminum|copper|zinc|brass|chrome|*stahl*|metall*|eisen|alu|kupfer|*blech|acier
steel,yes,métal|fer|inox|*staal|metaal|koper|*stål*|jern|järn|*teräs*|metalli|alumiini|acero|hierro|aluminio|acciaio
steel,yes,metallo|ferro|alluminio|rame|鋼|鉄|金属|アルミ
glass,no,glass|*glas|verre|lasi|vidrio|cristal|vetro|ガラス|polycarbonate
earth,no,earth|soil|gravel|sand|ballast|hardcore|topsoil|erde|*erdreich|*kies|schotter|lehm|terre|gravier|sable
earth,no,grond|zand|grind|jord|grus|pukk|sora|hiekka|sepeli|tierra|grava|arena|terra|ghiaia|terreno|砕石|砂利|土
)";

}  // namespace

const MaterialTable& MaterialTable::builtIn() {
    static const MaterialTable kTable = [] {
        auto parsed = parseCsv(kMaterials, "");
        SVT_CHECK(parsed.hasValue());
        return std::move(*parsed);
    }();
    return kTable;
}

}  // namespace svt::drawing
