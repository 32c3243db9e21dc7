// Footwall of lis1 for Gmsh: vertical breakaway at (0, 0), quarter circle of 15 km, flat at 15 km.
//   gmsh -2 -format msh22 meshes/lis1-footwall.geo -o my-footwall.msh
// Lengths in metres, y up. Physical lines: 1 left, 2 base, 3 right, 4 surface, 5 detachment.

radius = 15000;
left = -300000;
right = 350000;
depth = 30000;
near = 2500; // cell size at the detachment
far = 30000; // and at the sides

Point(1) = {0, 0, 0, near};
Point(2) = {radius, -radius, 0, near};
Point(3) = {60000, -radius, 0, near};
Point(4) = {right, -radius, 0, far};
Point(5) = {right, -depth, 0, far};
Point(6) = {60000, -depth, 0, 2 * near};
Point(7) = {-20000, -depth, 0, 2 * near};
Point(8) = {left, -depth, 0, far};
Point(9) = {left, 0, 0, far};
Point(10) = {-20000, 0, 0, 2 * near};
Point(11) = {radius, 0, 0}; // centre

Circle(1) = {1, 11, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 5};
Line(5) = {5, 6};
Line(6) = {6, 7};
Line(7) = {7, 8};
Line(8) = {8, 9};
Line(9) = {9, 10};
Line(10) = {10, 1};

// Anticlockwise, so that cells are not inverted.
Curve Loop(1) = {-10, -9, -8, -7, -6, -5, -4, -3, -2, -1};
Plane Surface(1) = {1};
Physical Curve(1) = {8};
Physical Curve(2) = {5, 6, 7};
Physical Curve(3) = {4};
Physical Curve(4) = {9, 10};
Physical Curve(5) = {1, 2, 3};
Physical Surface(1) = {1};

// Quadrilaterals only. Algorithm 8 with RecombineAll crashes in Gmsh 4.8.
Mesh.Algorithm = 6;
Mesh.RecombinationAlgorithm = 2;
Recombine Surface {1};
