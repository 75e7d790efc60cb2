// A quarter of a disc of radius 1, standing on (0, 0); its right half. Fine where it touches.
R = 1.0; fine = 0.008; coarse = 0.12;
Point(1) = {0, 0, 0, fine};
Point(2) = {0, R, 0, coarse};
Point(3) = {R, R, 0, coarse};
angle = 0.2;
Point(4) = {R * Sin(angle), R - R * Cos(angle), 0, fine * 1.6};
Circle(1) = {1, 2, 4};
Circle(2) = {4, 2, 3};
Line(3) = {3, 2};
Line(4) = {2, 1};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Physical Surface("disc") = {1};
Physical Curve("rim") = {1};
Physical Curve("top") = {3};
Physical Curve("axis") = {4};
Mesh.ElementOrder = 1;
