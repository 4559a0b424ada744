// Haines' sphere flake (Standard Procedural Databases, "balls") in clear glass, in a room: the twin of
// sphere_flake.gltf. Every sphere carries nine of a third of its radius, six round its equator and
// three above, "above" being away from the sphere that carries it.
//
// Depth is how many times; 6 makes 597,871 spheres. To choose it, include this file from one that
// declares it first: #declare Depth = 6; #include "sphere_flake.pov"
#version 3.7;
global_settings { assumed_gamma 1 }

#ifndef (Depth) #declare Depth = 3; #end

#declare Matte = finish { ambient 0 diffuse 1 }

// The model is right-handed, so the camera's right points the other way.
camera {
  location <2.1, 1.7, -1.3>
  right -x
  up y
  angle 45
  look_at 0
}

// ---- the room ----------------------------------------------------------------------------------

#declare Low = <-2.6, -0.5, -2.6>;
#declare High = <2.6, 2.6, 2.6>;

#macro Wall(A, B, C, D, Color)
  mesh {
    triangle { A, B, C }
    triangle { A, C, D }
    texture { pigment { color rgb Color } finish { Matte } }
  }
#end

#declare White = <0.75, 0.75, 0.73>;
Wall(<Low.x, Low.y, High.z>, <High.x, Low.y, High.z>, <High.x, Low.y, Low.z>, Low, <0.5, 0.47, 0.43>)
Wall(<Low.x, High.y, Low.z>, <High.x, High.y, Low.z>, High, <Low.x, High.y, High.z>, White)
Wall(Low, <High.x, Low.y, Low.z>, <High.x, High.y, Low.z>, <Low.x, High.y, Low.z>, White)
Wall(<High.x, Low.y, Low.z>, <High.x, Low.y, High.z>, High, <High.x, High.y, Low.z>, White)
Wall(<Low.x, Low.y, High.z>, Low, <Low.x, High.y, Low.z>, <Low.x, High.y, High.z>, <0.22, 0.36, 0.58>)
Wall(<High.x, Low.y, High.z>, <Low.x, Low.y, High.z>, <Low.x, High.y, High.z>, High, <0.68, 0.42, 0.16>)

mesh {
  triangle { <-1.1, 2.59, -1.1>, <1.1, 2.59, -1.1>, <1.1, 2.59, 1.1> }
  triangle { <-1.1, 2.59, -1.1>, <1.1, 2.59, 1.1>, <-1.1, 2.59, 1.1> }
  texture { pigment { color rgb <1, 0.96, 0.9> } finish { ambient 0 diffuse 0 emission 6.5 } }
}

// ---- the flake ---------------------------------------------------------------------------------

// Where the nine stand on a sphere whose "above" is z.
#declare D = 1 / sqrt(2);
#declare Trio = array[3] { <D, D, 0>, <D, 0, -D>, <0, D, -D> }
#declare Nine = array[9]
#for (Turn, 0, 2)
  #for (I, 0, 2)
    #declare Nine[3 * Turn + I] =
      vrotate(vaxis_rotate(Trio[I], <1, -1, 0>, degrees(asin(2 / sqrt(6)))), 120 * Turn * z);
  #end
#end

// The scene's y is the flake's z.
#macro Flake(Centre, Above, Radius, Levels)
  sphere { <Centre.x, Centre.z, -Centre.y>, Radius }
  #if (Levels > 0)
    // The shortest turn from z to Above.
    #local Axis = <-Above.y, Above.x, 0>;
    #for (I, 0, 8)
      #local Side = vcross(Axis, Nine[I]);
      #if (Above.z > -1)
        #local Outward = Nine[I] + Side + vcross(Axis, Side) / (1 + Above.z);
      #else
        #local Outward = Nine[I] * <-1, 1, -1>;
      #end
      Flake(Centre + Outward * (Radius * 4 / 3), Outward, Radius / 3, Levels - 1)
    #end
  #end
#end

union {
  Flake(<0, 0, 0>, z, 0.5, Depth)
  texture { pigment { color rgbt <1, 1, 1, 1> } finish { ambient 0 diffuse 0 } }
  interior { ior 1.5 }
}
