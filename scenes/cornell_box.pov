// The Cornell box as measured, https://www.graphics.cornell.edu/online/box/data.html, in units of
// 100 mm, with a spherical lamp: the twin of cornell_box_1.gltf.
#version 3.7;
global_settings { assumed_gamma 1 }

#declare Matte = finish { ambient 0 diffuse 1 }
#declare White = texture { pigment { color rgb 0.73 } finish { Matte } }
#declare Red = texture { pigment { color rgb <0.63, 0.065, 0.05> } finish { Matte } }
#declare Green = texture { pigment { color rgb <0.14, 0.45, 0.091> } finish { Matte } }

// The model is right-handed, so the camera's right points the other way.
camera {
  location <2.78, 2.73, -8>
  right -x
  up y
  angle 39.3
  look_at <2.78, 2.73, 0>
}

#macro Quad(A, B, C, D)
  mesh {
    triangle { A, B, C }
    triangle { A, C, D }
  }
#end

// A block from its top corners down to the floor.
#macro Block(A, B, C, D)
  #local Down = <1, 0, 1>;
  union {
    Quad(A, B, C, D)
    Quad(A, A * Down, B * Down, B)
    Quad(B, B * Down, C * Down, C)
    Quad(C, C * Down, D * Down, D)
    Quad(D, D * Down, A * Down, A)
  }
#end

union {
  Quad(<5.528, 0, 0>, <0, 0, 0>, <0, 0, 5.592>, <5.496, 0, 5.592>)
  Quad(<5.56, 5.488, 0>, <5.56, 5.488, 5.592>, <0, 5.488, 5.592>, <0, 5.488, 0>)
  Quad(<5.496, 0, 5.592>, <0, 0, 5.592>, <0, 5.488, 5.592>, <5.56, 5.488, 5.592>)
  texture { White }
}
object {
  Quad(<5.528, 0, 0>, <5.496, 0, 5.592>, <5.56, 5.488, 5.592>, <5.56, 5.488, 0>)
  texture { Red }
}
object {
  Quad(<0, 0, 5.592>, <0, 0, 0>, <0, 5.488, 0>, <0, 5.488, 5.592>)
  texture { Green }
}
object {
  Block(<1.30, 1.65, 0.65>, <0.82, 1.65, 2.25>, <2.40, 1.65, 2.72>, <2.90, 1.65, 1.14>)
  texture { White }
}
object {
  Block(<4.23, 3.30, 2.47>, <2.65, 3.30, 2.96>, <3.14, 3.30, 4.56>, <4.72, 3.30, 4.06>)
  texture { White }
}
sphere {
  <2.78, 4.6, 2.796>, 0.5
  texture {
    pigment { color rgb 1 }
    finish { ambient 0 diffuse 0 emission 17 }
  }
}
