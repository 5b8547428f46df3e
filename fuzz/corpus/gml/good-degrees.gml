<?xml version="1.0" encoding="utf-8" ?>
<ogr:FeatureCollection
     gml:id="aFeatureCollection"
     xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance"
     xsi:schemaLocation="http://ogr.maptools.org/ good-degrees.xsd"
     xmlns:ogr="http://ogr.maptools.org/"
     xmlns:gml="http://www.opengis.net/gml/3.2">
  <gml:boundedBy><gml:Envelope srsName="urn:ogc:def:crs:EPSG::4326"><gml:lowerCorner>60.1 24.9</gml:lowerCorner><gml:upperCorner>60.11 24.91</gml:upperCorner></gml:Envelope></gml:boundedBy>
                                                                                                                                                                
  <ogr:featureMember>
    <ogr:good_degrees gml:id="good_degrees.0">
      <gml:boundedBy><gml:Envelope srsName="urn:ogc:def:crs:EPSG::4326"><gml:lowerCorner>60.1 24.9</gml:lowerCorner><gml:upperCorner>60.11 24.91</gml:upperCorner></gml:Envelope></gml:boundedBy>
      <ogr:geometryProperty><gml:Polygon srsName="urn:ogc:def:crs:EPSG::4326" gml:id="good_degrees.geom.0"><gml:exterior><gml:LinearRing><gml:posList>60.1 24.9 60.1 24.91 60.11 24.91 60.1 24.9</gml:posList></gml:LinearRing></gml:exterior></gml:Polygon></ogr:geometryProperty>
      <ogr:name>a</ogr:name>
      <ogr:height>3.5</ogr:height>
      <ogr:levels>1</ogr:levels>
    </ogr:good_degrees>
  </ogr:featureMember>
</ogr:FeatureCollection>
