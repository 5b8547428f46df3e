<?xml version="1.0" encoding="utf-8" ?>
<ogr:FeatureCollection
     xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance"
     xsi:schemaLocation="http://ogr.maptools.org/ good-31.xsd"
     xmlns:ogr="http://ogr.maptools.org/"
     xmlns:gml="http://www.opengis.net/gml">
  <gml:boundedBy><gml:Envelope srsName="urn:ogc:def:crs:EPSG::3067"><gml:lowerCorner>385400 6671500</gml:lowerCorner><gml:upperCorner>385640 6671540</gml:upperCorner></gml:Envelope></gml:boundedBy>
                                                                                                                                                        
  <ogr:featureMember>
    <ogr:good_31 gml:id="good_31.0">
      <gml:boundedBy><gml:Envelope srsName="urn:ogc:def:crs:EPSG::3067"><gml:lowerCorner>385400 6671500</gml:lowerCorner><gml:upperCorner>385440 6671540</gml:upperCorner></gml:Envelope></gml:boundedBy>
      <ogr:geometryProperty><gml:Polygon srsName="urn:ogc:def:crs:EPSG::3067"><gml:exterior><gml:LinearRing><gml:posList>385400 6671500 385440 6671500 385440 6671540 385400 6671540 385400 6671500</gml:posList></gml:LinearRing></gml:exterior><gml:interior><gml:LinearRing><gml:posList>385410 6671510 385410 6671520 385420 6671520 385410 6671510</gml:posList></gml:LinearRing></gml:interior></gml:Polygon></ogr:geometryProperty>
      <ogr:name>a</ogr:name>
      <ogr:height>3.5</ogr:height>
      <ogr:levels>1</ogr:levels>
    </ogr:good_31>
  </ogr:featureMember>
  <ogr:featureMember>
    <ogr:good_31 gml:id="good_31.1">
      <gml:boundedBy><gml:Envelope srsName="urn:ogc:def:crs:EPSG::3067"><gml:lowerCorner>385500 6671500</gml:lowerCorner><gml:upperCorner>385640 6671540</gml:upperCorner></gml:Envelope></gml:boundedBy>
      <ogr:geometryProperty><gml:MultiSurface srsName="urn:ogc:def:crs:EPSG::3067"><gml:surfaceMember><gml:Polygon><gml:exterior><gml:LinearRing><gml:posList>385540 6671500 385540 6671540 385500 6671540 385500 6671500 385540 6671500</gml:posList></gml:LinearRing></gml:exterior></gml:Polygon></gml:surfaceMember><gml:surfaceMember><gml:Polygon><gml:exterior><gml:LinearRing><gml:posList>385640 6671500 385640 6671540 385600 6671540 385600 6671500 385640 6671500</gml:posList></gml:LinearRing></gml:exterior></gml:Polygon></gml:surfaceMember></gml:MultiSurface></ogr:geometryProperty>
      <ogr:name>b</ogr:name>
      <ogr:height>7</ogr:height>
      <ogr:levels>2</ogr:levels>
    </ogr:good_31>
  </ogr:featureMember>
</ogr:FeatureCollection>
