! SPDX-License-Identifier: GPL-3.0-or-later
! A grid from Fortran, by iso_c_binding. Usage: fortran_example NAME.nc, a file to write.
module calotte
  use iso_c_binding
  implicit none

  type, bind(c) :: calotte_error
    integer(c_int64_t) :: index
    character(kind=c_char) :: message(500)
  end type

  type, bind(c) :: calotte_triangulation
    integer(c_int) :: dimensions
    integer(c_int64_t) :: sites, triangles
    type(c_ptr) :: points, corners, neighbours
    integer(c_int64_t) :: inputs
    type(c_ptr) :: site_of_input
  end type

  type, bind(c) :: calotte_cvt_options
    type(c_funptr) :: density
    type(c_ptr) :: density_data
    type(c_funptr) :: progress
    type(c_ptr) :: progress_data
    real(c_double) :: tolerance
    integer(c_int64_t) :: iterations, seed
    integer(c_int32_t) :: well_centred
  end type

  type, bind(c) :: calotte_cvt_report
    integer(c_int32_t) :: converged, well_centred
    integer(c_int64_t) :: iterations
    real(c_double) :: residual, energy, seconds
  end type

  interface
    subroutine calotte_cvt_defaults(options) bind(c)
      import
      type(calotte_cvt_options), intent(out) :: options
    end subroutine
    integer(c_int) function calotte_grid(cells, options, mesh, report, error) bind(c)
      import
      integer(c_int64_t), value :: cells
      type(calotte_cvt_options), intent(in) :: options
      type(c_ptr), intent(inout) :: mesh
      type(calotte_cvt_report), intent(inout) :: report
      type(calotte_error), intent(inout) :: error
    end function
    subroutine calotte_mesh_view(mesh, view) bind(c)
      import
      type(c_ptr), value :: mesh
      type(calotte_triangulation), intent(out) :: view
    end subroutine
    integer(c_int) function calotte_write(path, mesh, sphere_radius, error) bind(c)
      import
      character(kind=c_char), intent(in) :: path(*)
      type(c_ptr), value :: mesh
      real(c_double), value :: sphere_radius
      type(calotte_error), intent(inout) :: error
    end function
    subroutine calotte_mesh_free(mesh) bind(c)
      import
      type(c_ptr), value :: mesh
    end subroutine
  end interface

contains

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
  type(calotte_cvt_options) :: options
  type(calotte_cvt_report) :: report
  type(calotte_triangulation) :: view
  type(calotte_error) :: error
  type(c_ptr) :: mesh = c_null_ptr
  real(c_double), pointer :: points(:, :)
  integer(c_int32_t), pointer :: corners(:, :)
  character(len=1000) :: path
  integer :: status

  call get_command_argument(1, path)
  call calotte_cvt_defaults(options)
  options%density = c_funloc(density)
  options%well_centred = 1
  status = calotte_grid(1000_c_int64_t, options, mesh, report, error)
  if (status /= 0) call fail(error)
  call calotte_mesh_view(mesh, view)
  call c_f_pointer(view%points, points, [3_c_int64_t, view%sites])
  call c_f_pointer(view%corners, corners, [3_c_int64_t, view%triangles])
  if (view%sites /= 1000 .or. view%triangles /= 1996) error stop 'a grid of 1000 cells has 1996 triangles'
  if (minval(corners) /= 0 .or. maxval(corners) /= 999) error stop 'the corners are sites'
  if (count(points(3, :) > 0) < 700) error stop 'most cells are on the northern hemisphere'
  status = calotte_write(trim(path) // c_null_char, mesh, 6371229.0_c_double, error)
  if (status /= 0) call fail(error)
  call calotte_mesh_free(mesh)
  mesh = c_null_ptr
  status = calotte_grid(3_c_int64_t, options, mesh, report, error)
  if (status /= 6 .or. c_associated(mesh)) error stop 'a grid of 3 cells is refused'

contains

  subroutine fail(problem)
    type(calotte_error), intent(in) :: problem
    integer :: i
    do i = 1, size(problem%message)
      if (problem%message(i) == c_null_char) exit
      write (*, '(a)', advance='no') problem%message(i)
    end do
    error stop
  end subroutine
end program
