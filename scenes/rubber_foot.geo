// A rubber foot of width 2 and height 1, in quads of 8 nodes.
Point(1) = {-1, 0, 0}; Point(2) = {1, 0, 0}; Point(3) = {1, 1, 0}; Point(4) = {-1, 1, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Transfinite Curve {1, 3} = 13; Transfinite Curve {2, 4} = 7;
Transfinite Surface {1};
Recombine Surface {1};
Physical Surface("rubber") = {1};
Physical Curve("sole") = {1};
Physical Curve("top") = {3};
Mesh.ElementOrder = 2; Mesh.SecondOrderIncomplete = 1;
