<?xml version="1.0" encoding="UTF-8"?>
<core:CityModel xmlns:core="http://www.opengis.net/citygml/3.0" xmlns:bldg="http://www.opengis.net/citygml/building/3.0" xmlns:gen="http://www.opengis.net/citygml/generics/3.0" xmlns:gml="http://www.opengis.net/gml/3.2">
<gml:name></gml:name>
<core:cityObjectMember><bldg:Building gml:id="b"><gml:name>B</gml:name></bldg:Building></core:cityObjectMember>
<core:cityObjectMember><gen:GenericOccupiedSpace gml:id="r"><gml:name></gml:name><gen:class>BuildingRoom</gen:class></gen:GenericOccupiedSpace></core:cityObjectMember>
<core:cityObjectMember><gen:GenericOccupiedSpace gml:id="label-2"><gml:name></gml:name><gen:class>WallSurface</gen:class></gen:GenericOccupiedSpace></core:cityObjectMember>
<core:cityObjectMember><gen:GenericOccupiedSpace gml:id="label-3"><gml:name></gml:name><gen:class>RoofSurface</gen:class></gen:GenericOccupiedSpace></core:cityObjectMember>
<core:cityObjectMember><bldg:Building gml:id="m"><gml:name></gml:name></bldg:Building></core:cityObjectMember>
<core:appearanceMember xmlns:core="http://www.opengis.net/citygml/3.0" xmlns:app="http://www.opengis.net/citygml/appearance/3.0" xmlns:gml="http://www.opengis.net/gml/3.2" xmlns:svt="urn:svt:citygml:ade:3.0"><app:Appearance gml:id="svt-appearance"><app:theme>SVT</app:theme><app:adeOfAppearance><svt:AppearanceVolumeProperties><svt:volumeData>
<svt:PixelTexture3D gml:id="svt-volume">
<gml:metaDataProperty><gml:GenericMetaData>{
  "format": "svt",
  "version": "1.0",
  "generator": "SVT",
  "byteOrder": "little",
  "tileSize": 64,
  "scalarCount": 5,
  "scalarBits": 8,
  "dimension": [4,3,5],
  "spacing": [0.3333333333333333,0.5,0.25],
  "origin": [10.0,20.0,30.0],
  "axes": [[1.0,0.0,0.0],[0.0,1.0,0.0],[0.0,0.0,1.0]],
  "crs": "https://www.opengis.net/def/crs/EPSG/0/25832",
  "model": "",
  "source": "cube.city.json"
}
</gml:GenericMetaData></gml:metaDataProperty>
<gml:metaDataProperty><gml:GenericMetaData>{"labels":[
{"id":"b","class":"Building","name":"B","parent":null,"subtreeEnd":4,"first":0,"count":0,"voxels":0,"volume":0.0,"filling":"none","color":[0.8352941,0.8117647,0.76862746],"opacity":1.0,"attributes":[{"name":"name","value":"B"},{"name":"storeys","value":2},{"name":"h","value":2.5},{"name":"old","value":true}]},
{"id":"r","class":"BuildingRoom","name":"","parent":0,"subtreeEnd":4,"first":1,"count":1,"voxels":0,"volume":6e-09,"filling":"solid","color":[0.56078434,0.72156864,0.84705883],"opacity":0.08,"thinVoxels":1},
{"id":"r/WallSurface[1]","class":"WallSurface","name":"","parent":1,"subtreeEnd":3,"first":2,"count":1,"voxels":0,"volume":0.0,"filling":"surface","color":[0.8509804,0.78039217,0.65882355],"opacity":1.0},
{"id":"r/RoofSurface[1]","class":"RoofSurface","name":"","parent":1,"subtreeEnd":4,"first":3,"count":1,"voxels":1,"volume":0.0,"filling":"surface","color":[0.65882355,0.28235295,0.22745098],"opacity":1.0},
{"id":"m","class":"Building","name":"","parent":null,"subtreeEnd":5,"first":4,"count":1,"voxels":23,"volume":1.0,"filling":"solid","color":[0.8352941,0.8117647,0.76862746],"opacity":1.0}],
"overlaps":[
[1,4,1,false]],
"phaseColors":[]}
</gml:GenericMetaData></gml:metaDataProperty>
<svt:scalarType>uint8</svt:scalarType>
<svt:dimension>4 3 5</svt:dimension>
<svt:spacing>0.3333333333333333 0.5 0.25</svt:spacing>
<svt:envelope srsName="https://www.opengis.net/def/crs/EPSG/0/25832" srsDimension="3"><gml:lowerCorner>10 20 30</gml:lowerCorner><gml:upperCorner>11 21 31</gml:upperCorner></svt:envelope>
<svt:sampleLocation>node</svt:sampleLocation>
<svt:backgroundValue>0</svt:backgroundValue>
<svt:volumeAssociation><svt:VolumeAssociation><svt:target>#b</svt:target><svt:scalarRange>1 3</svt:scalarRange></svt:VolumeAssociation></svt:volumeAssociation>
<svt:volumeAssociation><svt:VolumeAssociation><svt:target>#r</svt:target><svt:scalarRange>1 3</svt:scalarRange><svt:parent>#b</svt:parent></svt:VolumeAssociation></svt:volumeAssociation>
<svt:volumeAssociation><svt:VolumeAssociation><svt:target>#label-2</svt:target><svt:scalarRange>2 2</svt:scalarRange><svt:parent>#r</svt:parent></svt:VolumeAssociation></svt:volumeAssociation>
<svt:volumeAssociation><svt:VolumeAssociation><svt:target>#label-3</svt:target><svt:scalarRange>3 3</svt:scalarRange><svt:parent>#r</svt:parent></svt:VolumeAssociation></svt:volumeAssociation>
<svt:volumeAssociation><svt:VolumeAssociation><svt:target>#m</svt:target><svt:scalarRange>4 4</svt:scalarRange></svt:VolumeAssociation></svt:volumeAssociation>
<svt:image>1 4 3 5
3 4 4 0
4 4 4 0
0 0 0 0
4 4 4 0
4 4 4 0
0 0 0 0
4 4 4 0
4 4 4 0
0 0 0 0
4 4 4 0
4 4 4 0
0 0 0 0
0 0 0 0
0 0 0 0
0 0 0 0</svt:image>
</svt:PixelTexture3D>
</svt:volumeData></svt:AppearanceVolumeProperties></app:adeOfAppearance></app:Appearance></core:appearanceMember>
</core:CityModel>
