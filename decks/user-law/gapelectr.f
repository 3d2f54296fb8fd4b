C     Electrical conductance of a tin-plated terminal, S/m2.
C
C     Compile: gfortran -shared -fPIC -o gapelectr.so gapelectr.f
C     ABA_PARAM.INC beside this file stands in for that of Abaqus.
C
      SUBROUTINE GAPELECTR(SIGMA,D,TEMP,PREDEF,TIME,CINAME,SLNAME,
     1   MSNAME,COORDS,NODE,NPRED,KSTEP,KINC)
      INCLUDE 'ABA_PARAM.INC'
      CHARACTER*80 CINAME,SLNAME,MSNAME
      DIMENSION SIGMA(3),TEMP(2),PREDEF(2,*),TIME(2),COORDS(2,3)
C     S0 of clean tin at T0, falling by B a degree; DGAP is the gap over
C     which it fades; RWORN the radius outside which the plating is worn.
      PARAMETER (S0=8.0D8, T0=20.0D0, B=4.0D-3, DGAP=2.0D-6)
      PARAMETER (RWORN=5.0D-3, TAGE=1.0D3)
      IF (CINAME.NE.'TINNED' .OR. SLNAME.NE.'TERMINAL-FACE'
     1   .OR. MSNAME.NE.'BAR-FACE') RETURN
      S = S0*EXP(-MAX(D,0.0D0)/DGAP)
C     Field variable 1: the share of the face that is free from oxide.
      IF (NPRED.GE.1) S = S*0.5D0*(PREDEF(1,1)+PREDEF(2,1))
      R = SQRT(COORDS(1,1)**2+COORDS(1,2)**2)
      IF (R.GT.RWORN) S = 0.5D0*S
C     The oxide breaks after the first increment of clamping.
      IF (KSTEP.EQ.1 .AND. KINC.EQ.1) S = 0.1D0*S
C     In service it grows again, with the time since the step began.
      IF (KSTEP.EQ.2) S = S/(1.0D0+TIME(1)/TAGE)
      T = 0.5D0*(TEMP(1)+TEMP(2))
      SIGMA(1) = S/(1.0D0+B*(T-T0))
      SIGMA(2) = -0.5D0*B*SIGMA(1)/(1.0D0+B*(T-T0))
      SIGMA(3) = SIGMA(2)
      RETURN
      END
