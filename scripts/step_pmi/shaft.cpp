// Writes tests/data/step/pmi/shaft.stp: a shaft of three steps with dimensions, tolerances
// and datums, by Open CASCADE 7.6 (an independent writer of AP242).
//
//   g++ -std=c++17 shaft.cpp -I/usr/include/opencascade -lTKXDESTEP -lTKSTEP -lTKXCAF \
//       -lTKXSBase -lTKCAF -lTKCDF -lTKLCAF -lTKPrim -lTKBO -lTKBRep -lTKTopAlgo -lTKG3d \
//       -lTKMath -lTKernel -lTKVCAF -lTKSTEPBase -lTKSTEPAttr -lTKSTEP209 -o shaft
//   ./shaft shaft.stp
//
// Steps d1 30 x 40, d2 50 x 30, d3 25 x 50, along x.  Two habits of that version are
// allowed for: it takes lower deviations with the sign turned round, and writes the grade of a
// fit as its place in the enumeration, IT4 as '6'.
#include <BRepAdaptor_Surface.hxx>
#include <BRepAlgoAPI_Fuse.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <Interface_Static.hxx>
#include <STEPCAFControl_Controller.hxx>
#include <STEPCAFControl_Writer.hxx>
#include <TCollection_HAsciiString.hxx>
#include <TDataStd_Name.hxx>
#include <TDocStd_Document.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <XCAFApp_Application.hxx>
#include <XCAFDimTolObjects_DatumObject.hxx>
#include <XCAFDimTolObjects_DimensionObject.hxx>
#include <XCAFDimTolObjects_GeomToleranceObject.hxx>
#include <XCAFDoc_Datum.hxx>
#include <XCAFDoc_DimTolTool.hxx>
#include <XCAFDoc_Dimension.hxx>
#include <XCAFDoc_DocumentTool.hxx>
#include <XCAFDoc_GeomTolerance.hxx>
#include <XCAFDoc_MaterialTool.hxx>
#include <XCAFDoc_ShapeTool.hxx>
#include <cmath>
#include <gp_Ax2.hxx>
#include <gp_Cylinder.hxx>
#include <gp_Pln.hxx>
#include <stdexcept>

namespace {

using Dimension = XCAFDimTolObjects_DimensionObject;
using Tolerance = XCAFDimTolObjects_GeomToleranceObject;

TopoDS_Shape step(double x, double d, double l) {
  return BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(x, 0, 0), gp_Dir(1, 0, 0)), d / 2, l);
}

TopoDS_Shape shaft() {
  const TopoDS_Shape two = BRepAlgoAPI_Fuse(step(0, 30, 40), step(40, 50, 30));
  const TopoDS_Shape all = BRepAlgoAPI_Fuse(two, step(70, 25, 50));
  TopExp_Explorer solid(all, TopAbs_SOLID);
  return solid.Current();
}

template <class Wanted>
TopoDS_Face face(const TopoDS_Shape& part, Wanted wanted) {
  for (TopExp_Explorer e(part, TopAbs_FACE); e.More(); e.Next()) {
    const auto f = TopoDS::Face(e.Current());
    if (wanted(BRepAdaptor_Surface(f))) return f;
  }
  throw std::runtime_error("no such face");
}

TopoDS_Face cylinder(const TopoDS_Shape& part, double d) {
  return face(part, [d](const BRepAdaptor_Surface& s) {
    return s.GetType() == GeomAbs_Cylinder &&
           std::abs(s.Cylinder().Radius() - d / 2) < 1e-9;
  });
}

TopoDS_Face plane(const TopoDS_Shape& part, double x) {
  return face(part, [x](const BRepAdaptor_Surface& s) {
    return s.GetType() == GeomAbs_Plane && std::abs(s.Plane().Location().X() - x) < 1e-9;
  });
}

class Drawing {
 public:
  explicit Drawing(const TopoDS_Shape& part) {
    XCAFApp_Application::GetApplication()->NewDocument("MDTV-XCAF", document_);
    shapes_ = XCAFDoc_DocumentTool::ShapeTool(document_->Main());
    demands_ = XCAFDoc_DocumentTool::DimTolTool(document_->Main());
    part_ = shapes_->AddShape(part, Standard_False);
    TDataStd_Name::Set(part_, "SHAFT-3");
    const auto materials = XCAFDoc_DocumentTool::MaterialTool(document_->Main());
    materials->SetMaterial(part_, new TCollection_HAsciiString("C45"),
                           new TCollection_HAsciiString("quenched and tempered"), 7.85,
                           new TCollection_HAsciiString("density measure"),
                           new TCollection_HAsciiString("POSITIVE_RATIO_MEASURE"));
  }

  TDF_Label of(const TopoDS_Face& f) { return shapes_->AddSubShape(part_, f); }

  void diameter(const TopoDS_Face& f, double d, double lower, double upper) {
    const auto o = size(XCAFDimTolObjects_DimensionType_Size_Diameter, d);
    o->SetLowerTolValue(-lower);
    o->SetUpperTolValue(upper);
    add(o, of(f), TDF_Label());
  }

  void fit(const TopoDS_Face& f, double d, XCAFDimTolObjects_DimensionFormVariance form,
           XCAFDimTolObjects_DimensionGrade grade) {
    const auto o = size(XCAFDimTolObjects_DimensionType_Size_Diameter, d);
    o->SetClassOfTolerance(Standard_False, form, grade);
    add(o, of(f), TDF_Label());
  }

  void length(const TopoDS_Face& from, const TopoDS_Face& to, double l, double lower,
              double upper) {
    const auto o = size(XCAFDimTolObjects_DimensionType_Location_LinearDistance, l);
    o->SetLowerTolValue(-lower);
    o->SetUpperTolValue(upper);
    add(o, of(from), of(to));
  }

  TDF_Label tolerance(const TopoDS_Face& f, XCAFDimTolObjects_GeomToleranceType type,
                      double value) {
    const TDF_Label label = demands_->AddGeomTolerance();
    demands_->SetGeomTolerance(of(f), label);
    Handle(XCAFDoc_GeomTolerance) attribute;
    label.FindAttribute(XCAFDoc_GeomTolerance::GetID(), attribute);
    Handle(Tolerance) o = new Tolerance();
    o->SetType(type);
    o->SetValue(value);
    attribute->SetObject(o);
    return label;
  }

  void datum(const char* letter, const TopoDS_Face& f, const TDF_Label& tolerance) {
    const TDF_Label label = demands_->AddDatum();
    TDF_LabelSequence faces;
    faces.Append(of(f));
    demands_->SetDatum(faces, label);
    Handle(XCAFDoc_Datum) attribute;
    label.FindAttribute(XCAFDoc_Datum::GetID(), attribute);
    Handle(XCAFDimTolObjects_DatumObject) o = new XCAFDimTolObjects_DatumObject();
    o->SetName(new TCollection_HAsciiString(letter));
    o->SetPosition(1);
    attribute->SetObject(o);
    demands_->SetDatumToGeomTol(label, tolerance);
  }

  bool write(const char* path) {
    STEPCAFControl_Controller::Init();
    Interface_Static::SetCVal("write.step.schema", "AP242DIS");
    STEPCAFControl_Writer writer;
    writer.SetDimTolMode(Standard_True);
    writer.SetMaterialMode(Standard_True);
    return writer.Transfer(document_, STEPControl_AsIs) &&
           writer.Write(path) == IFSelect_RetDone;
  }

 private:
  static Handle(Dimension) size(XCAFDimTolObjects_DimensionType type, double value) {
    Handle(Dimension) o = new Dimension();
    o->SetType(type);
    o->SetValue(value);
    return o;
  }

  void add(const Handle(Dimension) & o, const TDF_Label& from, const TDF_Label& to) {
    const TDF_Label label = demands_->AddDimension();
    if (to.IsNull())
      demands_->SetDimension(from, label);
    else
      demands_->SetDimension(from, to, label);
    Handle(XCAFDoc_Dimension) attribute;
    label.FindAttribute(XCAFDoc_Dimension::GetID(), attribute);
    attribute->SetObject(o);
  }

  Handle(TDocStd_Document) document_;
  Handle(XCAFDoc_ShapeTool) shapes_;
  Handle(XCAFDoc_DimTolTool) demands_;
  TDF_Label part_;
};

}  // namespace

int main(int, char** argv) {
  const auto part = shaft();
  Drawing drawing(part);
  const auto d1 = cylinder(part, 30), d2 = cylinder(part, 50), d3 = cylinder(part, 25);
  const auto left = plane(part, 0), shoulder = plane(part, 40), right = plane(part, 120);
  drawing.fit(d1, 30, XCAFDimTolObjects_DimensionFormVariance_K,
              XCAFDimTolObjects_DimensionGrade_IT4);
  drawing.diameter(d2, 50, -0.1, 0.05);
  drawing.length(left, right, 120, -0.2, 0.3);
  drawing.length(left, shoulder, 40, -0.1, 0.1);
  drawing.tolerance(d1, XCAFDimTolObjects_GeomToleranceType_Cylindricity, 0.008);
  drawing.datum(
      "A", d1,
      drawing.tolerance(d3, XCAFDimTolObjects_GeomToleranceType_CircularRunout, 0.02));
  drawing.datum(
      "A", d1,
      drawing.tolerance(shoulder, XCAFDimTolObjects_GeomToleranceType_TotalRunout, 0.03));
  drawing.tolerance(left, XCAFDimTolObjects_GeomToleranceType_Flatness, 0.015);
  drawing.datum(
      "A", d1,
      drawing.tolerance(d2, XCAFDimTolObjects_GeomToleranceType_Coaxiality, 0.05));
  return drawing.write(argv[1]) ? 0 : 1;
}
