/** Texts of the basemap, English and German, as in texts.ts. Language files have them under the same keys. */

import { inLanguage } from "../texts";

const kBasemapTexts = {
  basemapFiles: ["Choose a picture", "Bild wählen"],
  basemapFilesHint: [
    "GeoTIFF, or PNG, JPEG or WebP with its world file (choose both)",
    "GeoTIFF, oder PNG, JPEG oder WebP mit Weltdatei (beide wählen)",
  ],
  basemapAddress: [
    "Or an address: tiles with {x}, {y} and {z}, or a picture",
    "Oder eine Adresse: Kacheln mit {x}, {y} und {z}, oder ein Bild",
  ],
  basemapAttribution: ["Source, shown in the picture", "Quelle, im Bild gezeigt"],
  basemapExtent: ["Place of a picture: west, south, east, north", "Ort eines Bilds: West, Süd, Ost, Nord"],
  basemapSystem: ["Coordinates of the picture", "Koordinaten des Bilds"],
  system_model: ["of the model{crs}", "des Modells{crs}"],
  system_3857: ["Web Mercator (EPSG:3857)", "Web Mercator (EPSG:3857)"],
  system_4326: ["Longitude, latitude (EPSG:4326)", "Länge, Breite (EPSG:4326)"],
  basemapShow: ["Show", "Zeigen"],
  basemapBusy: ["Being fetched", "Wird geholt"],
  basemapRemove: ["Remove", "Entfernen"],
  basemapHeight: ["Height", "Höhe"],
  basemapHeightHint: [
    "Parts of the model below this height are hidden, except from below.",
    "Teile des Modells unter dieser Höhe sind verborgen, außer von unten.",
  ],
  basemapPrivacy: [
    "Files stay on this computer. An address is asked only when you press Show. The server then learns the place of the model.",
    "Dateien bleiben auf diesem Rechner. Eine Adresse wird erst mit Zeigen angefragt. Der Server erfährt dann den Ort des Modells.",
  ],
  basemapFailed: ["No basemap", "Keine Grundkarte"],
  basemapShown: ["The basemap is shown.", "Die Grundkarte ist zu sehen."],
  needsExtent: [
    "{name} does not state its place. Enter west, south, east and north, or choose it together with its world file.",
    "{name} nennt seinen Ort nicht. West, Süd, Ost und Nord eingeben oder mit der Weltdatei zusammen wählen.",
  ],
  badExtent: [
    "The place of a picture is four numbers: west, south, east, north. East is more than west, and north more than south.",
    "Der Ort eines Bilds sind vier Zahlen: West, Süd, Ost, Nord. Ost ist größer als West, Nord größer als Süd.",
  ],
  otherSystem: [
    "The picture has the coordinates of EPSG:{epsg}, the model those of {crs}. Convert the picture, for example by gdalwarp.",
    "Das Bild hat die Koordinaten von EPSG:{epsg}, das Modell die von {crs}. Das Bild umwandeln, zum Beispiel mit gdalwarp.",
  ],
  notNear: [
    "The picture does not lie below the model. Check its coordinates: west {west}, south {south}, east {east}, north {north}; the model is near {x}, {y}.",
    "Das Bild liegt nicht unter dem Modell. Seine Koordinaten prüfen: West {west}, Süd {south}, Ost {east}, Nord {north}; das Modell liegt bei {x}, {y}.",
  ],
  noSystem: [
    "The model does not state where on earth it is, so tiles cannot be placed. A picture with coordinates of the model is possible. ({reason})",
    "Das Modell nennt seinen Ort auf der Erde nicht, daher lassen sich Kacheln nicht einpassen. Ein Bild mit Koordinaten des Modells ist möglich. ({reason})",
  ],
  onlyWorldFile: ["A world file gives the place of a picture: choose both.", "Eine Weltdatei nennt den Ort eines Bilds: beide wählen."],
  badWorldFile: ["{name}: a world file has six numbers, one per line.", "{name}: Eine Weltdatei hat sechs Zahlen, eine je Zeile."],
  notPicture: [
    "This browser cannot read the picture {name}. Choose GeoTIFF, PNG, JPEG or WebP.",
    "Dieser Browser kann das Bild {name} nicht lesen. GeoTIFF, PNG, JPEG oder WebP wählen.",
  ],
  tiffSize: ["The TIFF has no pixels, or more than 400 million.", "Das TIFF hat keine Pixel oder mehr als 400 Millionen."],
  tiffDamaged: ["The TIFF is damaged or incomplete.", "Das TIFF ist beschädigt oder unvollständig."],
  tiffSamples: [
    "The TIFF does not have 8 bits per sample in gray, RGB or palette colours. Convert it, for example by gdal_translate -ot Byte.",
    "Das TIFF hat nicht 8 Bit je Wert in Grau, RGB oder Palettenfarben. Umwandeln, zum Beispiel mit gdal_translate -ot Byte.",
  ],
  tiffCompression: [
    "The TIFF is compressed by method {n}. Convert it, for example by gdal_translate -co COMPRESS=DEFLATE.",
    "Das TIFF ist mit Verfahren {n} gepackt. Umwandeln, zum Beispiel mit gdal_translate -co COMPRESS=DEFLATE.",
  ],
  badAddress: [
    "'{address}' cannot be used. Give the address of tiles, such as https://example.org/{z}/{x}/{y}.png, or of a picture.",
    "'{address}' ist nicht verwendbar. Die Adresse von Kacheln angeben, etwa https://example.org/{z}/{x}/{y}.png, oder die eines Bilds.",
  ],
  policy: [
    "This page may not fetch pictures from {origin}. Start it by svt serve --allow-images {origin}, or save the picture and choose the file.",
    "Diese Seite darf keine Bilder von {origin} holen. Sie mit svt serve --allow-images {origin} starten oder das Bild speichern und die Datei wählen.",
  ],
  noAnswer: ["{origin} does not have a picture at this address.", "{origin} hat unter dieser Adresse kein Bild."],
  noAnswerElsewhere: [
    "No picture came from {origin}. The address may be wrong, the server may not answer, or it may not let other sites show its pictures (CORS).",
    "Von {origin} kam kein Bild. Die Adresse kann falsch sein, der Server nicht antworten oder anderen Seiten seine Bilder nicht erlauben (CORS).",
  ],
} as const satisfies Record<string, readonly [string, string]>;

export function basemapText(key: keyof typeof kBasemapTexts, values: Record<string, string | number> = {}): string {
  return inLanguage(key, kBasemapTexts[key], values);
}

/** The English of these texts, for translation in a language file. */
export function basemapTemplate(): Record<string, string> {
  return Object.fromEntries(Object.entries(kBasemapTexts).map(([key, [english]]) => [key, english]));
}
