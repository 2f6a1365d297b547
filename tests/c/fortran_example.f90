! SPDX-License-Identifier: GPL-3.0-or-later
! A grid from Fortran, by iso_c_binding. Usage: fortran_example NAME.nc, a file to write.
module calotte
  use iso_c_binding
  implicit none

  ! The types of calotte/c.h. A program calls calotte_recipe_init() for a recipe, and for others
  ! sets `size` to c_sizeof(variable); what else it does not set has its default.
  type, bind(c) :: calotte_error
    integer(c_size_t) :: size = 0
    integer(c_int64_t) :: index = 0
    character(kind=c_char) :: message(512) = c_null_char
  end type

  type, bind(c) :: calotte_surface
    integer(c_size_t) :: size = 0
    integer(c_int64_t) :: kind = 0
    real(c_double) :: period(2) = 0
    integer(c_int64_t) :: rings = 0
    type(c_ptr) :: corners = c_null_ptr, begin = c_null_ptr
  end type

  type, bind(c) :: calotte_recipe
    integer(c_size_t) :: size = 0
    integer(c_int64_t) :: initialised = 0
    integer(c_int64_t) :: cells = 0
    type(c_ptr) :: surface = c_null_ptr
    type(c_funptr) :: density = c_null_funptr
    type(c_ptr) :: density_data = c_null_ptr
    type(c_ptr) :: widths = c_null_ptr, widths_x = c_null_ptr, widths_y = c_null_ptr
    integer(c_int64_t) :: widths_nx = 0, widths_ny = 0
    real(c_double) :: earth_radius_km = 0
    type(c_ptr) :: fixed = c_null_ptr
    integer(c_int64_t) :: fixed_count = 0
    type(c_ptr) :: start_points = c_null_ptr
    integer(c_int64_t) :: start_count = 0
    type(c_ptr) :: start = c_null_ptr, norm = c_null_ptr, method = c_null_ptr
    integer(c_int64_t) :: bisections = 0, insertion_rounds = 0
    real(c_double) :: tolerance = 0
    integer(c_int64_t) :: max_iterations = 0, iterations = 0, well_centred = 0
    real(c_double) :: least_spacing = 0
    integer(c_int64_t) :: seed = 0
    integer(c_int64_t) :: limited_area = 0, walls_x = 0, walls_y = 0
    integer(c_int64_t) :: boundary_generators = 0, refuse_duplicates = 0
    real(c_double) :: merge_within = 0
    type(c_ptr) :: widths_file = c_null_ptr
    real(c_double) :: most_off_midpoint = 0
  end type

  type, bind(c) :: calotte_report
    integer(c_size_t) :: size = 0
    integer(c_int64_t) :: converged = 0, well_centred = 0, cells_beyond_limits = 0, worst_cell = 0
    integer(c_int64_t) :: iterations = 0
    real(c_double) :: residual = 0, energy = 0, seconds = 0
  end type

  type, bind(c) :: calotte_triangulation
    integer(c_size_t) :: size = 0
    integer(c_int64_t) :: dimensions = 0, sites = 0, triangles = 0
    type(c_ptr) :: points = c_null_ptr, corners = c_null_ptr, neighbours = c_null_ptr
    integer(c_int64_t) :: inputs = 0
    type(c_ptr) :: site_of_input = c_null_ptr
  end type

  interface
    subroutine calotte_recipe_init_sized(recipe, size) bind(c)
      import
      type(calotte_recipe), intent(inout) :: recipe
      integer(c_size_t), value :: size
    end subroutine
    integer(c_int) function calotte_make_grid(recipe, progress, progress_data, mesh, report, error) &
        bind(c)
      import
      type(calotte_recipe), intent(in) :: recipe
      type(c_funptr), value :: progress
      type(c_ptr), value :: progress_data
      type(c_ptr), intent(inout) :: mesh
      type(calotte_report), intent(inout) :: report
      type(calotte_error), intent(inout) :: error
    end function
    integer(c_int) function calotte_mesh_view(mesh, view, error) bind(c)
      import
      type(c_ptr), value :: mesh
      type(calotte_triangulation), intent(inout) :: view
      type(calotte_error), intent(inout) :: error
    end function
    integer(c_int) function calotte_write_grid(path, mesh, recipe, sphere_radius, error) bind(c)
      import
      character(kind=c_char), intent(in) :: path(*)
      type(c_ptr), value :: mesh
      type(calotte_recipe), intent(in) :: recipe
      real(c_double), value :: sphere_radius
      type(calotte_error), intent(inout) :: error
    end function
    subroutine calotte_mesh_free(mesh) bind(c)
      import
      type(c_ptr), value :: mesh
    end subroutine
  end interface

contains

  ! Sets the size and all defaults.
  subroutine calotte_recipe_init(recipe)
    type(calotte_recipe), intent(inout) :: recipe
    call calotte_recipe_init_sized(recipe, c_sizeof(recipe))
  end subroutine

  ! Widths differ by two between the hemispheres.
  integer(c_int) function density(xyz, n, rho, data) bind(c)
    integer(c_int64_t), value :: n
    real(c_double), intent(in) :: xyz(3, n)
    real(c_double), intent(out) :: rho(n)
    type(c_ptr), value :: data
    rho = merge(1.0_c_double, 0.0625_c_double, xyz(3, :) > 0)
    density = merge(1, 0, c_associated(data))
  end function
end module

program fortran_example
  use calotte
  implicit none
  type(calotte_recipe) :: recipe
  type(calotte_surface), target :: box
  type(calotte_report) :: report
  type(calotte_triangulation) :: view
  type(calotte_error) :: error
  type(c_ptr) :: mesh = c_null_ptr
  real(c_double), pointer :: points(:, :)
  integer(c_int32_t), pointer :: corners(:, :)
  real(c_double), target :: fixed(3, 2) = reshape([1, 0, 0, 0, 1, 0], [3, 2])
  character(kind=c_char, len=8), target :: method = 'lloyd' // c_null_char
  character(len=1000) :: path

  report%size = c_sizeof(report)
  view%size = c_sizeof(view)
  error%size = c_sizeof(error)
  box%size = c_sizeof(box)
  call get_command_argument(1, path)

  call calotte_recipe_init(recipe)
  recipe%cells = 1000
  recipe%density = c_funloc(density)
  recipe%fixed = c_loc(fixed)
  recipe%fixed_count = 2
  call require(calotte_make_grid(recipe, c_null_funptr, c_null_ptr, mesh, report, error))
  if (report%well_centred /= 1) error stop 'the grid is well-centred'
  call look(3_c_int64_t)
  if (view%sites /= 1000 .or. view%triangles /= 1996) error stop 'a grid of 1000 cells has 1996 triangles'
  if (minval(corners) /= 0 .or. maxval(corners) /= 999) error stop 'the corners are sites'
  if (count(points(3, :) > 0) < 700) error stop 'most cells are on the northern hemisphere'
  if (maxval(abs(points(:, 1:2) - fixed)) > 0) error stop 'the fixed points are the first sites'
  call require(calotte_write_grid(trim(path) // c_null_char, mesh, recipe, 6371229.0_c_double, error))
  call calotte_mesh_free(mesh)

  ! A periodic box, by Lloyd's method.
  box%kind = 1
  box%period = [2, 1]
  call calotte_recipe_init(recipe)
  recipe%cells = 200
  recipe%surface = c_loc(box)
  recipe%method = c_loc(method)
  recipe%tolerance = 1e-3_c_double
  recipe%well_centred = 0
  call require(calotte_make_grid(recipe, c_null_funptr, c_null_ptr, mesh, report, error))
  call look(2_c_int64_t)
  if (report%converged /= 1 .or. view%triangles /= 400) error stop 'a box of 200 cells has 400 triangles'
  call calotte_mesh_free(mesh)

  mesh = c_null_ptr
  recipe%cells = 2
  if (calotte_make_grid(recipe, c_null_funptr, c_null_ptr, mesh, report, error) /= 6 &
      .or. c_associated(mesh)) error stop 'a grid of 2 cells is refused'
  recipe = calotte_recipe(size=c_sizeof(recipe), cells=200)
  if (calotte_make_grid(recipe, c_null_funptr, c_null_ptr, mesh, report, error) /= 6) &
    error stop 'a recipe without its defaults is refused'

contains

  ! Points to the arrays of the mesh.
  subroutine look(dimensions)
    integer(c_int64_t), intent(in) :: dimensions
    call require(calotte_mesh_view(mesh, view, error))
    if (view%dimensions /= dimensions) error stop 'the dimensions of the points'
    call c_f_pointer(view%points, points, [dimensions, view%sites])
    call c_f_pointer(view%corners, corners, [3_c_int64_t, view%triangles])
  end subroutine

  subroutine require(status)
    integer(c_int), intent(in) :: status
    integer :: i
    if (status == 0) return
    do i = 1, size(error%message)
      if (error%message(i) == c_null_char) exit
      write (*, '(a)', advance='no') error%message(i)
    end do
    error stop
  end subroutine
end program
