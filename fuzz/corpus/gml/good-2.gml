<?xml version="1.0" encoding="utf-8" ?>
<ogr:FeatureCollection
     xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance"
     xsi:schemaLocation="http://ogr.maptools.org/ good-2.xsd"
     xmlns:ogr="http://ogr.maptools.org/"
     xmlns:gml="http://www.opengis.net/gml">
  <gml:boundedBy>
    <gml:Box>
      <gml:coord><gml:X>385400</gml:X><gml:Y>6671500</gml:Y></gml:coord>
      <gml:coord><gml:X>385640</gml:X><gml:Y>6671540</gml:Y></gml:coord>
    </gml:Box>
  </gml:boundedBy>
                                                                                                                                          
  <gml:featureMember>
    <ogr:good_2 fid="good_2.0">
      <ogr:geometryProperty><gml:Polygon srsName="EPSG:3067"><gml:outerBoundaryIs><gml:LinearRing><gml:coordinates>385400,6671500 385440,6671500 385440,6671540 385400,6671540 385400,6671500</gml:coordinates></gml:LinearRing></gml:outerBoundaryIs><gml:innerBoundaryIs><gml:LinearRing><gml:coordinates>385410,6671510 385410,6671520 385420,6671520 385410,6671510</gml:coordinates></gml:LinearRing></gml:innerBoundaryIs></gml:Polygon></ogr:geometryProperty>
      <ogr:name>a</ogr:name>
      <ogr:height>3.5</ogr:height>
      <ogr:levels>1</ogr:levels>
    </ogr:good_2>
  </gml:featureMember>
  <gml:featureMember>
    <ogr:good_2 fid="good_2.1">
      <ogr:geometryProperty><gml:MultiPolygon srsName="EPSG:3067"><gml:polygonMember><gml:Polygon><gml:outerBoundaryIs><gml:LinearRing><gml:coordinates>385540,6671500 385540,6671540 385500,6671540 385500,6671500 385540,6671500</gml:coordinates></gml:LinearRing></gml:outerBoundaryIs></gml:Polygon></gml:polygonMember><gml:polygonMember><gml:Polygon><gml:outerBoundaryIs><gml:LinearRing><gml:coordinates>385640,6671500 385640,6671540 385600,6671540 385600,6671500 385640,6671500</gml:coordinates></gml:LinearRing></gml:outerBoundaryIs></gml:Polygon></gml:polygonMember></gml:MultiPolygon></ogr:geometryProperty>
      <ogr:name>b</ogr:name>
      <ogr:height>7</ogr:height>
      <ogr:levels>2</ogr:levels>
    </ogr:good_2>
  </gml:featureMember>
</ogr:FeatureCollection>
